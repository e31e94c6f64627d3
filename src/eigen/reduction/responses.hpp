// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Friction forces on free modes. Their static responses start a basis.
#include <vector>

#include "algebra/linalg/block.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/subspace/basis.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::reduction {

using subspace::Basis;

/// Collective. Returns this rank's rows of orthogonal columns f that span the forces [M.29]
///   k d_i   and   kᵀ d_i,   k = Σ c (iω_i)^power A,
/// except for components of length `resolution`. The parts of a force with even and with odd powers
/// are separate columns, each scaled to length 1. The d_i are the columns of the basis that follow
/// the constraint modes, one per frequency ω_i of a free mode, rad/s. The sum is over the friction
/// terms and over all other terms that belong only to this point. The responses K0⁻¹ f are the
/// changes of the right and left vectors due to these terms, to first order in the terms and to
/// lowest order in the frequency.
linalg::Block forcesOnModes(const Basis& basis, const pencil::Pencil& pencil,
                            const sweep::Parameters& at, const std::vector<double>& frequencies,
                            double resolution);

}  // namespace squeal::reduction
