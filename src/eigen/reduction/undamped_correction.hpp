// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Improvement of the watched eigenpairs of a dense problem without damping after its basis has
/// grown. Not collective.
#include <optional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/reduction/pair_group.hpp"

namespace squeal::reduction {

/// Returns the watched eigenpairs of
///   (s² M + K) q = 0,
/// with right and left vectors. `pairs` are those of a smaller basis; their vectors are padded with
/// zeros. `watched` must select all eigenvalues in a disc |s| < R except strongly damped ones, so
/// that it selects the eigenvalues t = −1/s² of K⁻¹M of largest magnitude. Their right and left
/// vectors are iterated together: the problem is projected on the vectors and on K⁻¹M times those
/// of the pairs in `open`, and the Ritz vectors are multiplied by K⁻¹M once more. This is repeated
/// until the residuals of these pairs are as small as UnconvergedPair requires. Returns none if
/// that fails.
std::optional<std::vector<linalg::DensePair>> correctedUndamped(
    const linalg::DenseProblem& problem, std::vector<linalg::DensePair> pairs,
    const std::vector<UnconvergedPair>& open, const linalg::EigenvalueFilter& watched);

}  // namespace squeal::reduction
