// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bounds of sparse matrices in an energy, each confirmed by the inertia of a sparse matrix.
#include "eigen/proof/kept.hpp"
#include "eigen/referee/split_problem.hpp"

namespace squeal::referee {

/// Collective. Adds to `bounds` those of M_a, C and G on the space C on which M ≤ `bounds.mass` in
/// the energy. With H = K0 + M / mass, every matrix A ≤ g H satisfies A ≤ 2 g on that space. The
/// inertia of g H − A, or of [g H, A; Aᵀ, g H] for an antisymmetric A, confirms such a g, which is
/// less than 1.2 times the smallest one. Throws Error if none is confirmed.
void boundOthers(const SplitProblem& problem, const factor::AssociatedSystem& system,
                 proof::LeftOut& bounds);

}  // namespace squeal::referee
