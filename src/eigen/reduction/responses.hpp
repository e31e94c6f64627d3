// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Static responses to friction are the beginning of a basis.
#include <vector>

#include "algebra/linalg/block.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/subspace/basis.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::reduction {

using subspace::Basis;

/// Collective. Returns orthogonal columns f, by this rank's rows, that hold the forces [M.29]
///   k d_i   and   kᵀ d_i,   k = Σ c (iω_i)^power A,
/// except for parts of length `resolution`. The parts of even and of odd powers are columns of
/// their own, each of length 1. d_i stands for the columns of the basis that follow the constraint
/// modes, one for each of the frequencies ω_i of free modes, rad/s. The sum is over the terms of
/// friction and over all others that belong only to this point. The responses K0⁻¹ f are the change
/// of the right and left vectors with these terms, to first order in them and to lowest order in
/// the frequency.
linalg::Block forcesOnModes(const Basis& basis, const pencil::Pencil& pencil,
                            const sweep::Parameters& at, const std::vector<double>& frequencies,
                            double resolution);

}  // namespace squeal::reduction
