// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Vectors that are real or come in pairs of conjugates, stored as real numbers as in LAPACK: the
/// real part in the place of the first vector of a pair, and the imaginary part in that of the
/// second one. With the complex vectors as columns of X and the stored ones as columns of X_r,
///   X = X_r U,
/// where U has the block [1 1; i −i] for each pair and 1 for each real vector. Products in real
/// numbers take a quarter of the work. Not collective.
#include <vector>

#include "algebra/linalg/complexdense.hpp"

namespace squeal::proof {

/// The place of a vector.
enum class Member : unsigned char {
  real,   ///< a real vector
  first,  ///< the first vector of a pair; the second one follows
  second  ///< the conjugate of the vector before
};
using ConjugatePairs = std::vector<Member>;

/// Returns X_r U.
linalg::ComplexMatrix complexColumns(const linalg::DenseMatrix& stored,
                                     const ConjugatePairs& pairs);
/// Returns U⁻¹ Y_r: the rows of the inverse of X from those of the inverse of X_r.
linalg::ComplexMatrix complexRows(const linalg::DenseMatrix& stored, const ConjugatePairs& pairs);
/// Returns U⁻¹ A U.
linalg::ComplexMatrix complexForm(const linalg::DenseMatrix& a, const ConjugatePairs& pairs);
/// Returns U G, so that X G = X_r (U G).
linalg::ComplexMatrix storedRows(linalg::ComplexMatrix g, const ConjugatePairs& pairs);

}  // namespace squeal::proof
