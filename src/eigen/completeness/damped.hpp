// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The proof that the lists of points with damping, gyroscopic terms, or friction that depends on
/// the steady state are complete, in the basis of the sweep (docs/method.md, section 13).
#include <functional>
#include <vector>

#include "eigen/completeness/settings.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/friction_factors.hpp"
#include "eigen/reduction/reduced.hpp"

namespace squeal::completeness {

/// A point with its list. The pointers are borrowed.
struct DampedList {
  const reduction::PointProblem* problem;
  pencil::ComplexModes* list;  ///< its solution
  /// Collective. Returns the factors of the friction of the point.
  std::function<pencil::PointFactors()> friction;
};

/// Not collective. Returns true if proveDamped() covers the problem of a point: the terms without
/// friction are the same at all points and sparse, and only one of them has s².
bool coversDamped(const reduction::PointProblem& problem, const pencil::JumpFactors& factors);

/// What the points have in common. Handles and references are borrowed.
struct DampedSweep {
  const factor::AssociatedSystem& system;  ///< K0 and M0 of the interior unknowns
  const modes::Modes& modes;               ///< the free modes of `system`
  /// [interior unknown of this rank] its row on this rank; empty: all unknowns are interior
  const std::vector<PetscInt>& interior;
  const pencil::JumpFactors& factors;
  const Settings& settings;
  /// Collective; called with the points whose proofs have ended last.
  std::function<void(const std::vector<pencil::ComplexModes*>&)> afterPoints;
};

/// Collective. Extends the basis by corrections of eigenvectors above the band and by the static
/// responses to forces at the jumps of `factors`, and proves the lists in the manner of prove().
/// All problems must be covered. Throws Interrupted between two groups of points once a stop has
/// been requested.
void proveDamped(reduction::ReducedProblem& reduced, const DampedSweep& sweep,
                 const std::vector<DampedList>& points);

}  // namespace squeal::completeness
