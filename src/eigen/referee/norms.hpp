// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bounds of sparse matrices relative to an energy, each confirmed by the inertia of a sparse
/// matrix.
#include "eigen/proof/kept.hpp"
#include "eigen/referee/split_problem.hpp"

namespace squeal::referee {

/// Collective. Adds to `bounds` the bounds of the matrices M_a, C and G on the space that V leaves
/// out. On this space, M ≤ `bounds.mass` in the energy K0. With H = K0 + M / mass, every matrix
/// A ≤ g H therefore satisfies A ≤ 2 g there. The inertia of g H − A, or of [g H, A; Aᵀ, g H] for
/// an antisymmetric A, confirms g. It is less than 1.2 times the smallest possible one, or has
/// nearly no effect on δ of a region with |s| ≤ `top` and Re s ≥ −`left`, rad/s. Throws Error if no
/// g is confirmed.
void boundOthers(const SplitProblem& problem, const factor::AssociatedSystem& system, double top,
                 double left, proof::LeftOut& bounds);

}  // namespace squeal::referee
