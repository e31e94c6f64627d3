// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Damping by one ratio per free mode.
#include <vector>

#include "eigen/modes/modes.hpp"
#include "eigen/pencil/pencil.hpp"

namespace squeal::pencil {

/// Collective. Returns the term of modal damping [M.22],
///   c C_m,   C_m = Σ 2 ζ_i ω_i (M0 d_i)(M0 d_i)ᵀ,
/// where `ratios` contains the ζ_i and its last entry applies to all further modes. Returns no term
/// if all ratios are zero. `mass` is M0. The arguments may be destroyed after the call. The matrix
/// supports only products with vectors.
std::vector<Term> modalDamping(const modes::Modes& modes, Mat mass,
                               const std::vector<double>& ratios);

}  // namespace squeal::pencil
