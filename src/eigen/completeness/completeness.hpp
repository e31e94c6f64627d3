// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The proof that the lists of a sweep are complete (docs/method.md, section 13).
#include <vector>

#include "eigen/completeness/friction_factors.hpp"
#include "eigen/completeness/settings.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/reduction/reduced.hpp"

namespace squeal::completeness {

/// The points with one active set.
struct ProvedSet {
  std::vector<PetscInt> rows;                     ///< of the factors, ascending
  std::vector<reduction::PointProblem> problems;  ///< at least one
  std::vector<pencil::ComplexModes*> points;      ///< [problem] solved, borrowed
};

/// Collective. Adds the static responses to the slip rows to the basis, and sets the completeness
/// of each point and the radii of its eigenvalues. `modes` are the free modes of `system`, of the
/// interior unknowns. If their count reaches hardly beyond the band, they are counted once more.
void prove(reduction::ReducedProblem& reduced, const factor::AssociatedSystem& system,
           const modes::Modes& modes, const FrictionFactors& factors,
           const std::vector<ProvedSet>& sets, const Settings& settings);

}  // namespace squeal::completeness
