#pragma once
/// Small dense linear systems by LAPACK's LU with partial pivoting. Not collective.
#include <petscsys.h>

#include <vector>

namespace squeal::linalg {

/// Factors of a square matrix of doubles or std::complex<double>.
template <class Scalar>
class Lu {
 public:
  /// n × n, column-major.
  Lu(std::vector<Scalar> matrix, int n);
  /// Smallest pivot over the largest; 0: the matrix is singular.
  double pivotRatio() const { return pivotRatio_; }
  /// Gives pivots of zero the size of rounding: solutions then go along the null vector, which
  /// inverse iteration wants.
  void raiseZeroPivots();
  /// b ← A⁻¹ b, or A⁻ᴴ b, for b of any number of columns. Pivots of zero: infinite.
  void solve(std::vector<Scalar>& b, bool adjoint = false) const;

 private:
  PetscBLASInt n_;
  std::vector<Scalar> factors_;
  std::vector<PetscBLASInt> rows_;  // exchanged
  double largest_ = 0, pivotRatio_ = 0;
};

}  // namespace squeal::linalg
