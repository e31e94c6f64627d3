#pragma once
/// Static responses to friction as the beginning of a basis.
#include <vector>

#include "linalg/block.hpp"
#include "pencil/pencil.hpp"
#include "reduction/basis.hpp"
#include "sweep/parameters.hpp"

namespace squeal::reduction {

/// Collective. Returns orthogonal columns f, this rank's rows, that hold the forces
///   k φ_i   and   kᵀ φ_i,   k = Σ c (iω_i)^power A,
/// each with length 1, but for parts of length `resolution`. φ_i are the first columns of the
/// basis, one for each of the frequencies ω_i of free modes, rad/s. The sum is over the terms of
/// friction and over all others that belong to this point alone. The responses K0⁻¹ f are the
/// change of the right and left vectors with these terms, to first order in them and to lowest
/// order in the frequency.
linalg::Block forcesOnModes(const Basis& basis, const pencil::Pencil& pencil,
                            const sweep::Parameters& at, const std::vector<double>& frequencies,
                            double resolution);

}  // namespace squeal::reduction
