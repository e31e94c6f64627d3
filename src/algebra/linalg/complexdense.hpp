// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Products, orthonormalisation and eigenvectors of small dense complex matrices, by BLAS and
/// LAPACK. Not collective.
#include "algebra/linalg/dense.hpp"

namespace squeal::linalg {

/// Returns A X, or Aᵀ X if `transposed`, for a real matrix A. An empty A stands for a square matrix
/// of zeros.
ComplexMatrix product(const DenseMatrix& a, const ComplexMatrix& x, bool transposed = false);
/// Returns X C.
ComplexMatrix product(const ComplexMatrix& x, const ComplexMatrix& c);
/// Returns Xᴴ Y.
ComplexMatrix adjointProduct(const ComplexMatrix& x, const ComplexMatrix& y);

/// Replaces the columns of X by orthonormal columns, whose span contains that of the old ones
/// (Householder). X must have at most as many columns as rows. No column may be zero or have
/// infinite entries. Throws Error if LAPACK fails.
void orthonormalise(ComplexMatrix& x);

/// All eigenvalues of a matrix A, with the right vectors X and the left vectors Y,
///   A X = X diag(value),   Yᴴ A = diag(value) Yᴴ.
struct ComplexEigen {
  std::vector<Complex> value;
  ComplexMatrix right, left;  ///< columns of 2-norm 1
};

/// Returns the eigenvalues and vectors of a square matrix, unsorted. Throws Error if LAPACK fails.
ComplexEigen eigen(ComplexMatrix a);

}  // namespace squeal::linalg
