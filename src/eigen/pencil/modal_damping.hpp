#pragma once
/// Damping given by a ratio for each free mode.
#include <vector>

#include "eigen/modes/modes.hpp"
#include "eigen/pencil/pencil.hpp"

namespace squeal::pencil {

/// Collective. Returns the term of modal damping [M.22],
///   c C_m,   C_m = Σ 2 ζ_i ω_i (M0 d_i)(M0 d_i)ᵀ,
/// with the ratios of `-flutter_modal_damping`; none if all of these are zero. `mass` is M0, and
/// the arguments are not needed afterwards. The matrix can only be multiplied.
std::vector<Term> modalDamping(const modes::Modes& modes, Mat mass);
/// Returns true if `-flutter_modal_damping` has a ratio that is positive.
bool modalDampingWanted();

}  // namespace squeal::pencil
