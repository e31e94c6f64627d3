// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/lu.hpp"

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

// PETSc built with real scalars declares only the real routines.
extern "C" {
void zgetrf_(const PetscBLASInt* m, const PetscBLASInt* n, squeal::Complex* a,
             const PetscBLASInt* lda, PetscBLASInt* pivots, PetscBLASInt* info);
void zgetrs_(const char* trans, const PetscBLASInt* n, const PetscBLASInt* columns,
             const squeal::Complex* a, const PetscBLASInt* lda, const PetscBLASInt* pivots,
             squeal::Complex* b, const PetscBLASInt* ldb, PetscBLASInt* info);
}

namespace squeal::linalg {
namespace {

constexpr const char* sizesFit = "a right-hand side has the rows of the matrix";

void factor(PetscBLASInt n, double* a, PetscBLASInt* rows) {
  PetscBLASInt info = 0;
  LAPACKgetrf_(&n, &n, a, &n, rows, &info);
}

void factor(PetscBLASInt n, Complex* a, PetscBLASInt* rows) {
  PetscBLASInt info = 0;
  zgetrf_(&n, &n, a, &n, rows, &info);
}

void solveWith(const char* side, PetscBLASInt n, PetscBLASInt columns, const double* a,
               const PetscBLASInt* rows, double* b) {
  PetscBLASInt info = 0;
  LAPACKgetrs_(side, &n, &columns, const_cast<double*>(a), &n, const_cast<PetscBLASInt*>(rows), b,
               &n, &info);
}

void solveWith(const char* side, PetscBLASInt n, PetscBLASInt columns, const Complex* a,
               const PetscBLASInt* rows, Complex* b) {
  PetscBLASInt info = 0;
  zgetrs_(side, &n, &columns, a, &n, rows, b, &n, &info);
}

}  // namespace

template <class Scalar>
Lu<Scalar>::Lu(Dense<Scalar> matrix) : factors_(std::move(matrix)), rows_(factors_.rows()) {
  ensure(factors_.rows() == factors_.columns(), "a matrix to be factored is square");
  const PetscBLASInt n = factors_.rows();
  if (n > 0) factor(n, factors_.data(), rows_.data());
  double smallest = std::numeric_limits<double>::infinity();
  for (PetscInt i = 0; i < n; ++i) {
    const double pivot = std::abs(factors_(i, i));
    if (!(pivot >= smallest)) smallest = pivot;  // a NaN stays, and its ratio is 0
    largest_ = std::max(largest_, pivot);
  }
  pivotRatio_ = smallest / largest_ > 0 ? smallest / largest_ : 0;
}

template <class Scalar>
void Lu<Scalar>::raiseZeroPivots() {
  if (pivotRatio_ > 0) return;
  pivotRatio_ = std::numeric_limits<double>::epsilon();
  for (PetscInt i = 0; i < factors_.rows(); ++i)
    if (factors_(i, i) == 0.0) factors_(i, i) = pivotRatio_ * (largest_ > 0 ? largest_ : 1);
}

template <class Scalar>
void Lu<Scalar>::solve(Scalar* b, PetscBLASInt columns, bool adjoint) const {
  const PetscBLASInt n = factors_.rows();
  if (n > 0 && columns > 0)
    solveWith(adjoint ? "C" : "N", n, columns, factors_.data(), rows_.data(), b);
}

template <class Scalar>
void Lu<Scalar>::solve(Dense<Scalar>& b, bool adjoint) const {
  ensure(b.rows() == factors_.rows(), sizesFit);
  solve(b.data(), b.columns(), adjoint);
}

template <class Scalar>
void Lu<Scalar>::solve(std::span<Scalar> b, bool adjoint) const {
  ensure(std::ssize(b) == factors_.rows(), sizesFit);
  solve(b.data(), 1, adjoint);
}

template class Lu<double>;
template class Lu<Complex>;

}  // namespace squeal::linalg
