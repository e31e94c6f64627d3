// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/norm_bound.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "algebra/linalg/symmetric.hpp"

// PETSc built with real scalars declares only the real routines.
extern "C" {
void zherk_(const char* triangle, const char* side, const PetscBLASInt* n, const PetscBLASInt* k,
            const double* alpha, const squeal::Complex* a, const PetscBLASInt* lda,
            const double* beta, squeal::Complex* c, const PetscBLASInt* ldc);
void zhemv_(const char* triangle, const PetscBLASInt* n, const squeal::Complex* alpha,
            const squeal::Complex* a, const PetscBLASInt* lda, const squeal::Complex* x,
            const PetscBLASInt* stepX, const squeal::Complex* beta, squeal::Complex* y,
            const PetscBLASInt* stepY);
void zpotrf_(const char* triangle, const PetscBLASInt* n, squeal::Complex* a,
             const PetscBLASInt* lda, PetscBLASInt* info);
}

namespace squeal::proof {
namespace {

double squared(double entry) { return entry * entry; }
double squared(Complex entry) { return std::norm(entry); }

template <class Matrix>
double quick(const Matrix& a) {
  std::vector<double> rowSums(a.rows());
  double squares = 0, largestColumn = 0, largestRow = 0;
  for (PetscInt j = 0; j < a.columns(); ++j) {
    double sum = 0;
    for (PetscInt i = 0; i < a.rows(); ++i) {
      const double square = squared(a(i, j)), size = std::sqrt(square);
      squares += square;
      sum += size;
      rowSums[i] += size;
    }
    largestColumn = std::max(largestColumn, sum);
  }
  for (const double sum : rowSums) largestRow = std::max(largestRow, sum);
  return std::sqrt(std::min(squares, largestColumn * largestRow));
}

/// Returns the lower triangle of AᴴA or of A Aᴴ, the smaller one.
linalg::ComplexMatrix gram(const linalg::ComplexMatrix& a) {
  const bool wide = a.rows() < a.columns();
  const PetscBLASInt n = wide ? a.rows() : a.columns(), inner = wide ? a.columns() : a.rows(),
                     stride = a.rows();
  const double one = 1, zero = 0;
  linalg::ComplexMatrix result(n, n);
  zherk_("L", wide ? "N" : "C", &n, &inner, &one, a.data(), &stride, &zero, result.data(), &n);
  return result;
}

/// Returns a lower estimate of the largest eigenvalue of a Hermitian matrix, by the Lanczos method.
double largestEigenvalue(const linalg::ComplexMatrix& h) {
  constexpr int most = 12;
  constexpr double settled = 1e-8;  // of the next direction
  const PetscBLASInt n = h.rows(), step = 1;
  const Complex one = 1, zero = 0;
  std::vector<Complex> x(n), before(n), y(n);
  for (PetscBLASInt i = 0; i < n; ++i)
    x[i] = std::sqrt(std::max(h(i, i).real(), 0.0)) * (1 + 0.3 * std::sin(1.0 + i));
  double size = length(x);
  linalg::DenseMatrix tridiagonal(most, most);
  int steps = 0;
  while (steps < most && size > (steps > 0 ? settled * tridiagonal(0, 0) : 0)) {
    for (auto& entry : x) entry /= size;
    zhemv_("L", &n, &one, h.data(), &n, x.data(), &step, &zero, y.data(), &step);
    const double diagonal = innerProduct(x, y).real();
    tridiagonal(steps, steps) = diagonal;
    if (steps > 0) tridiagonal(steps, steps - 1) = size;
    for (PetscBLASInt i = 0; i < n; ++i)
      y[i] -= diagonal * x[i] + (steps > 0 ? size : 0.0) * before[i];
    before = std::exchange(x, y);
    size = length(x);
    ++steps;
  }
  if (steps == 0) return 0;
  linalg::DenseMatrix used(steps, steps);
  for (int j = 0; j < steps; ++j)
    for (int i = j; i < steps; ++i) used(i, j) = tridiagonal(i, j);
  return linalg::symmetricEigenvalues(std::move(used)).back();
}

/// Returns true if bound − H is positive definite, for H given by its lower triangle.
bool above(double bound, linalg::ComplexMatrix h) {
  PetscBLASInt n = h.rows(), info = 0;
  for (PetscInt j = 0; j < n; ++j) {
    for (PetscInt i = j; i < n; ++i) h(i, j) = -h(i, j);
    h(j, j) += bound;
  }
  zpotrf_("L", &n, h.data(), &n, &info);
  return info == 0;
}

}  // namespace

double quickBound(const linalg::ComplexMatrix& a) { return quick(a); }
double quickBound(const linalg::DenseView& a) { return quick(a); }

double normBound(const linalg::ComplexMatrix& a) {
  const double quick = quickBound(a);
  if (a.rows() <= 1 || a.columns() <= 1 || !(quick > 0) || !std::isfinite(quick)) return quick;
  const auto h = gram(a);
  // Round-off of the products and of the factorisation, relative to the squared Frobenius norm,
  // which is at most n times the squared 2-norm.
  const double n = h.rows(),
               roundOff = 1 + 4 * (n + std::max(a.rows(), a.columns())) *
                                  std::numeric_limits<double>::epsilon(),
               guess = largestEigenvalue(h);
  for (const double factor : {1.002, 1.02, 1.1, 1.4}) {
    const double square = guess * factor * factor;
    if (!(std::sqrt(square * roundOff) < quick)) break;
    if (above(square, h)) return std::sqrt(square * roundOff);
  }
  return quick;
}

}  // namespace squeal::proof
