// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The shares of the free modes in a complex mode.
#include <span>
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "algebra/linalg/complexvector.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"

namespace squeal::pencil {

/// A motion x e^{st} in the unknowns of K0 and M0; x is borrowed.
struct ComplexMotion {
  Complex s;
  const linalg::ComplexVector* x;
};

/// Collective. Returns the participations of all modes in each motion, [motion][mode]. With
/// q_i = d_iᵀ M0 x [M.88],
///   x = Σ q_i d_i + rest,   energy share = (|s|² + ω_i²) |q_i|² / (|s|² xᴴ M0 x + xᴴ K0 x),
///   MAC = |q_i|² / xᴴ M0 x.
/// The energy shares of all modes add up to at most 1, and so do the MACs, since the modes are
/// orthogonal in M0 and in K0. The amplitudes q_i are divided by √(xᴴ M0 x), and by a phase that
/// makes the largest one real and positive.
std::vector<std::vector<Participation>> participations(const modes::Modes& modes,
                                                       const factor::AssociatedSystem& system,
                                                       std::span<const ComplexMotion> motions);

}  // namespace squeal::pencil
