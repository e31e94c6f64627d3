// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The inverse of a dense symmetric matrix that may be singular. Not collective.
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::impedance {

/// The inverse of a symmetric matrix that should be positive definite. If it is not, the inverse of
/// its positive part is used: eigenvectors whose eigenvalue is at most 1e-12 of the largest one,
/// such as rigid-body modes of open parts, are omitted.
class SymmetricInverse {
 public:
  SymmetricInverse() = default;  ///< of order 0
  explicit SymmetricInverse(linalg::DenseMatrix a);
  /// Returns the smallest pivot of Cholesky's method as a fraction of the diagonal entry in its
  /// row: of the order of the machine precision for a matrix that is singular to within round-off,
  /// and 0 if the method fails.
  double leastPivot() const { return leastPivot_; }
  /// Replaces the columns of x by A⁻¹ x.
  void apply(linalg::DenseMatrix& x) const;

 private:
  linalg::DenseMatrix factor_;  // Cholesky factor, or eigenvectors
  std::vector<double> values_;  // eigenvalues, if the matrix is not positive definite
  double leastPivot_ = 1;
};

}  // namespace squeal::impedance
