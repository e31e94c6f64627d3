// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Search for eigenvalues that the improvement of known ones has missed.
#include <optional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::reduction {

/// Not collective. Searches for wanted eigenvalues that are missing from these pairs, and returns
/// one if any is found. The pairs must have right and left vectors. The known eigenvalues and their
/// conjugates are deflated; the shift-and-invert Arnoldi method then finds the unknown ones nearest
/// to the shift. A start vector of random entries has a component along every eigenvector with
/// probability one. Throws Error if LAPACK fails.
std::optional<Complex> findMissing(const linalg::DenseProblem& problem,
                                   const std::vector<linalg::DensePair>& pairs, Complex shift,
                                   const linalg::EigenvalueFilter& wanted);

}  // namespace squeal::reduction
