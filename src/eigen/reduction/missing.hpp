// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A search for eigenvalues that improvements of known ones have missed.
#include <optional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::reduction {

/// Not collective. Looks for an eigenvalue that is wanted and not among these pairs, which have
/// both vectors: the known eigenvalues and their conjugates are deflated, and the Arnoldi method on
/// the operator of shift-and-invert finds the unknown ones nearest to the shift σ. A starting
/// vector of random entries has a component along every eigenvector with probability one. Throws
/// Error if LAPACK fails.
std::optional<Complex> findMissing(const linalg::DenseProblem& problem,
                                   const std::vector<linalg::DensePair>& pairs, Complex shift,
                                   const linalg::Wanted& wanted);

}  // namespace squeal::reduction
