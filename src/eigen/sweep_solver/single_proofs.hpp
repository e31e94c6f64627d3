// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The proof that the list of a point is complete, whatever terms the problem of the point has.
#include <functional>
#include <vector>

#include "eigen/completeness/settings.hpp"
#include "eigen/modes/settings.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sweep_solver/listed_point.hpp"
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

/// The settings of the proofs of a sweep.
struct ProofRequest {
  const completeness::Settings& settings;  ///< borrowed
  const modes::Settings& modes;            ///< of the free modes; borrowed
  std::function<void()> afterPoints;       ///< collective; called after some points are judged
};

/// Collective. Lets the referee judge the lists of these points, each with matrices, free modes and
/// a basis of its own; the basis contains the eigenvectors of the reduced problem. Sets
/// ComplexModes::completeness, and the radius of each eigenvalue that is proved. The number of free
/// modes in the settings is not used. Throws Interrupted between two points once a stop has been
/// requested.
void proveSingly(const SweepProblem& problem, const reduction::ReducedProblem& reduced,
                 const std::vector<ListedPoint*>& points, const ProofRequest& request);

}  // namespace squeal::sweep_solver
