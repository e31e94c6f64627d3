// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Products with the basis V and what is known of its free modes, for the proofs of a sweep.
#include <optional>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "eigen/completeness/kept_span.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/reduction/reduced.hpp"

namespace squeal::completeness {

/// Collective. Returns the columns of Aᵀ for a matrix of few rows, by this rank's rows.
linalg::Block columnsOf(Mat rows);

/// Not collective. Appends the real part of a vector, and its imaginary part unless it is zero,
/// extended by zeros.
void appendParts(const std::vector<Complex>& vector, linalg::DenseMatrix& columns);

/// Not collective. Returns a matrix of pseudorandom signs, always the same ones.
linalg::DenseMatrix randomSigns(PetscInt rows, PetscInt columns);

/// Collective. Returns Vᵀ M K0⁻¹ M V with K0⁻¹ of the interior; zero where both vectors are not
/// among the first `solved` ones of V, which take a solve each. The modes d need no solves, as K0⁻¹
/// M d = d/λ.
linalg::DenseMatrix massFlexibility(reduction::ReducedProblem& reduced, const KnownModes& modes,
                                    const std::vector<double>& lambda, Mat mass, PetscInt solved);

/// Collective. Adds the part that massFlexibility() has left out.
void completeMassFlexibility(reduction::ReducedProblem& reduced, Mat mass, PetscInt solved,
                             linalg::DenseMatrix& product);

/// The reason why nothing is proved without KnownModes.
inline constexpr const char* unconfirmed = "the number of free modes is not confirmed";

/// Collective. Returns the known properties of the free modes, which follow the constraint modes in
/// the basis; nothing if their number is not confirmed. If it is confirmed only up to slightly
/// above the band, the modes are counted again at a higher frequency. `associated` has the terms of
/// K0 and M0.
std::optional<KnownModes> knownModes(reduction::ReducedProblem& reduced,
                                     const factor::AssociatedSystem& system,
                                     const modes::Modes& modes, const pencil::Pencil& associated);

}  // namespace squeal::completeness
