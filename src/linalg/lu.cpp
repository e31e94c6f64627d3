#include "linalg/lu.hpp"

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

// PETSc built with real scalars declares the real routines only.
extern "C" {
void zgetrf_(const PetscBLASInt* m, const PetscBLASInt* n, std::complex<double>* a,
             const PetscBLASInt* lda, PetscBLASInt* pivots, PetscBLASInt* info);
void zgetrs_(const char* trans, const PetscBLASInt* n, const PetscBLASInt* columns,
             const std::complex<double>* a, const PetscBLASInt* lda, const PetscBLASInt* pivots,
             std::complex<double>* b, const PetscBLASInt* ldb, PetscBLASInt* info);
}

namespace squeal::linalg {
namespace {

void factor(PetscBLASInt n, double* a, PetscBLASInt* rows) {
  PetscBLASInt info = 0;
  LAPACKgetrf_(&n, &n, a, &n, rows, &info);
}

void factor(PetscBLASInt n, std::complex<double>* a, PetscBLASInt* rows) {
  PetscBLASInt info = 0;
  zgetrf_(&n, &n, a, &n, rows, &info);
}

void solveWith(const char* side, PetscBLASInt n, PetscBLASInt columns, const double* a,
               const PetscBLASInt* rows, double* b) {
  PetscBLASInt info = 0;
  LAPACKgetrs_(side, &n, &columns, const_cast<double*>(a), &n, const_cast<PetscBLASInt*>(rows), b,
               &n, &info);
}

void solveWith(const char* side, PetscBLASInt n, PetscBLASInt columns,
               const std::complex<double>* a, const PetscBLASInt* rows, std::complex<double>* b) {
  PetscBLASInt info = 0;
  zgetrs_(side, &n, &columns, a, &n, rows, b, &n, &info);
}

}  // namespace

template <class Scalar>
Lu<Scalar>::Lu(std::vector<Scalar> matrix, int n)
    : n_(n), factors_(std::move(matrix)), rows_(static_cast<std::size_t>(n)) {
  if (n > 0) factor(n_, factors_.data(), rows_.data());
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < factors_.size(); i += static_cast<std::size_t>(n) + 1) {
    smallest = std::min(smallest, std::abs(factors_[i]));
    largest_ = std::max(largest_, std::abs(factors_[i]));
  }
  pivotRatio_ = largest_ > 0 ? smallest / largest_ : 0;
}

template <class Scalar>
void Lu<Scalar>::raiseZeroPivots() {
  if (pivotRatio_ > 0) return;
  pivotRatio_ = std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < factors_.size(); i += static_cast<std::size_t>(n_) + 1)
    if (factors_[i] == 0.0) factors_[i] = pivotRatio_ * largest_;
}

template <class Scalar>
void Lu<Scalar>::solve(std::vector<Scalar>& b, bool adjoint) const {
  if (n_ > 0)
    solveWith(adjoint ? "C" : "N", n_, static_cast<PetscBLASInt>(b.size()) / n_, factors_.data(),
              rows_.data(), b.data());
}

template class Lu<double>;
template class Lu<std::complex<double>>;

}  // namespace squeal::linalg
