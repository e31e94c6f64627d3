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

/// The points of a sweep that share the same active set.
struct ProvedSet {
  std::vector<PetscInt> rows;  ///< of the FrictionFactors that the set uses, ascending
  std::vector<reduction::PointProblem> problems;  ///< at least one
  std::vector<pencil::ComplexModes*> points;      ///< [problem] solved, borrowed
};

/// Collective. Extends the basis by the static responses to forces in the slip rows. Sets the
/// completeness of each point and, for each of its eigenvalues, the radius of the disc that
/// contains it. `modes` are the free modes of `system`, which has only the interior unknowns
/// (subspace::Substructure). If their number is known only to just above the band, they are counted
/// again at a higher frequency.
void prove(reduction::ReducedProblem& reduced, const factor::AssociatedSystem& system,
           const modes::Modes& modes, const FrictionFactors& factors,
           const std::vector<ProvedSet>& sets, const Settings& settings);

}  // namespace squeal::completeness
