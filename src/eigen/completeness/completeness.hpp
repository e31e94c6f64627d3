// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The proof that the lists of eigenvalues of a sweep are complete (docs/method.md, section 13).
#include <vector>

#include "eigen/completeness/settings.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/friction_factors.hpp"
#include "eigen/reduction/reduced.hpp"

namespace squeal::completeness {

/// The points of a sweep that have the same active set.
struct ProvedSet {
  std::vector<PetscInt> rows;  ///< rows of FrictionFactors that the active set uses, ascending
  std::vector<reduction::PointProblem> problems;  ///< the problems of the points; at least one
  std::vector<pencil::ComplexModes*> points;      ///< [problem] its solution, borrowed
};

/// Returns true if prove() covers the problem of a point: apart from the terms of K0 and M0, it has
/// only friction terms whose matrices all points share, and none that is linear in s.
bool covers(const reduction::PointProblem& problem, const pencil::FrictionFactors& factors);

/// Collective. Extends the basis by K0⁻¹ Sᵀ, the static responses to forces along the slip rows S
/// of `factors`. All problems must be covered. Sets ComplexModes::completeness of each point and
/// Eigenvalue::radius of each one that is proved to be the only one in a disc. `modes` are the free
/// modes of `system`, which has only the interior unknowns (subspace::Substructure). The proof
/// needs the number of these modes up to well above the band. If their number is confirmed only up
/// to slightly above the band, they are counted again at a higher frequency.
void prove(reduction::ReducedProblem& reduced, const factor::AssociatedSystem& system,
           const modes::Modes& modes, const pencil::FrictionFactors& factors,
           const std::vector<ProvedSet>& sets, const Settings& settings);

/// Collective. Copies to all ranks what the owners (linalg::onOwners()) have found about these
/// points: ComplexModes::completeness and the eigenvalues.
void share(MPI_Comm comm, const std::vector<pencil::ComplexModes*>& points);

}  // namespace squeal::completeness
