#pragma once
/// Small dense linear systems by LAPACK's LU with partial pivoting. Not collective.
#include <petscsys.h>

#include <vector>

namespace squeal::linalg {

/// Factors of a square matrix of doubles or std::complex<double>.
template <class Scalar>
class Lu {
 public:
  /// Factorises a matrix, n × n, column-major, which is taken.
  Lu(std::vector<Scalar> matrix, int n);
  /// Returns the smallest pivot divided by the largest, in magnitude; 0 for a singular matrix.
  double pivotRatio() const { return pivotRatio_; }
  /// Replaces pivots of zero by the machine precision times the largest pivot. Solutions then point
  /// along the null vector, as inverse iteration needs.
  void raiseZeroPivots();
  /// Replaces b, which has any number of columns, by A⁻¹ b, or by A⁻ᴴ b if `adjoint`. A pivot of
  /// zero gives infinite entries.
  void solve(std::vector<Scalar>& b, bool adjoint = false) const;

 private:
  PetscBLASInt n_;
  std::vector<Scalar> factors_;
  std::vector<PetscBLASInt> rows_;  // exchanged
  double largest_ = 0, pivotRatio_ = 0;
};

}  // namespace squeal::linalg
