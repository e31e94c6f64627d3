// SPDX-License-Identifier: BSD-2-Clause
#include "steady/uniqueness/positivity.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/linalg/lapack.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/check.hpp"

namespace squeal::uniqueness {

using linalg::DenseMatrix;

namespace {

/// Numbers below this relative size count as round-off. A comes from solves with a stiffness matrix
/// whose condition number may exceed 1e6.
constexpr double rounding = 1e-10;

/// Returns true if all principal minors of a matrix with unit diagonal are positive.
bool positiveMinors(const DenseMatrix& a) {
  if (!(a(0, 0) > rounding)) return false;
  const PetscInt m = a.rows() - 1;
  if (m == 0) return true;
  DenseMatrix rest(m, m), complement(m, m);
  for (PetscInt j = 0; j < m; ++j)
    for (PetscInt i = 0; i < m; ++i) {
      rest(i, j) = a(i + 1, j + 1);
      complement(i, j) = rest(i, j) - a(i + 1, 0) * a(0, j + 1) / a(0, 0);
    }
  return positiveMinors(rest) && positiveMinors(complement);
}

}  // namespace

std::vector<double> eigenvaluesOfSymmetricPart(const DenseMatrix& a) {
  return linalg::symmetricEigenvalues(linalg::symmetricPart(a));
}

bool positiveDefinite(const std::vector<double>& eigenvalues) {
  return eigenvalues.front() > rounding * eigenvalues.back();
}

bool pMatrix(const DenseMatrix& a) {
  const PetscInt n = a.rows();
  DenseMatrix unit(n, n);
  for (PetscInt i = 0; i < n; ++i)
    if (!(a(i, i) > 0)) return false;
  // Positive scaling of rows and columns preserves the signs of the minors.
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < n; ++i) unit(i, j) = a(i, j) / std::sqrt(a(i, i) * a(j, j));
  return positiveMinors(unit);
}

bool surelyCopositive(const DenseMatrix& a) {
  DenseMatrix s = linalg::symmetricPart(a);
  for (PetscInt j = 0; j < s.columns(); ++j)
    for (PetscInt i = 0; i < s.rows(); ++i)
      if (i != j) s(i, j) = std::min(s(i, j), 0.0);
  return positiveDefinite(eigenvaluesOfSymmetricPart(s));
}

Judgement examineMatrix(const DenseMatrix& a, double friction, int pMatrixLimit) {
  const auto eigenvalues = eigenvaluesOfSymmetricPart(a);
  const double smallest = eigenvalues.front();
  if (positiveDefinite(eigenvalues))
    return {friction, smallest, "one solution", "the condensed matrix is positive definite"};
  const bool tested = a.rows() <= pMatrixLimit;
  if (tested && pMatrix(a))
    return {friction, smallest, "one solution", "the condensed matrix is a P-matrix"};
  const std::string notUnique =
      tested ? "no P-matrix: for some loads there is not exactly one solution"
             : "not positive definite";
  if (surelyCopositive(a))
    return {friction, smallest, "a solution exists",
            "the condensed matrix is strictly copositive, but " + notUnique};
  return {friction, smallest, "not decided", "the condensed matrix is " + notUnique};
}

double lossOfPositivity(double smallestRatio) {
  // Ratios are of the order of one, with at least the tolerance of the iterative solver.
  return smallestRatio < -1e-7 ? -1 / smallestRatio : std::numeric_limits<double>::infinity();
}

double lossOfPositivity(const DenseMatrix& a0, const DenseMatrix& a1) {
  DenseMatrix s0 = linalg::symmetricPart(a0), s1 = linalg::symmetricPart(a1);
  PetscBLASInt type = 1, n = a0.rows(), info = 0;
  std::vector<double> values(n);
  linalg::callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKsygv_(&type, "N", "U", &n, s1.data(), &n, s0.data(), &n, values.data(), work, &length,
                &info);
  });
  if (info > n) return 0;
  if (info != 0)
    throw Error("LAPACK dsygv failed on the condensed matrix of the contact (info " +
                std::to_string(info) + ")");
  return lossOfPositivity(values.front());
}

}  // namespace squeal::uniqueness
