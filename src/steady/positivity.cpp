#include "steady/positivity.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "linalg/symmetric.hpp"
#include "petsc/check.hpp"

namespace squeal::steady {
namespace {

/// Relative size below which numbers count as rounding. A comes from solves with a stiffness matrix
/// of a condition number of 1e6 and more.
constexpr double rounding = 1e-10;

std::vector<double> symmetricPart(const std::vector<double>& a, std::size_t n) {
  std::vector<double> s(n * n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) s[j * n + i] = 0.5 * (a[j * n + i] + a[i * n + j]);
  return s;
}

/// Returns true if all principal minors are positive, for a matrix that first has a unit diagonal.
bool positiveMinors(const std::vector<double>& a, std::size_t n) {
  if (!(a[0] > rounding)) return false;
  if (n == 1) return true;
  const std::size_t m = n - 1;
  std::vector<double> rest(m * m), complement(m * m);
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < m; ++i) {
      rest[j * m + i] = a[(j + 1) * n + i + 1];
      complement[j * m + i] = rest[j * m + i] - a[i + 1] * a[(j + 1) * n] / a[0];
    }
  return positiveMinors(rest, m) && positiveMinors(complement, m);
}

}  // namespace

std::vector<double> symmetricEigenvalues(const std::vector<double>& a, int size) {
  std::vector<double> s = symmetricPart(a, size);
  return linalg::symmetricEigen(s, size);
}

bool positiveDefinite(const std::vector<double>& eigenvalues) {
  return eigenvalues.front() > rounding * eigenvalues.back();
}

bool pMatrix(const std::vector<double>& a, int size) {
  const std::size_t n = size;
  std::vector<double> unit(n * n);
  for (std::size_t i = 0; i < n; ++i)
    if (!(a[i * n + i] > 0)) return false;
  // Positive scaling of rows and columns keeps the signs of the minors.
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i)
      unit[j * n + i] = a[j * n + i] / std::sqrt(a[i * n + i] * a[j * n + j]);
  return positiveMinors(unit, n);
}

bool surelyCopositive(const std::vector<double>& a, int size) {
  const std::size_t n = size;
  std::vector<double> s = symmetricPart(a, size);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i)
      if (i != j) s[j * n + i] = std::min(s[j * n + i], 0.0);
  return positiveDefinite(symmetricEigenvalues(s, size));
}

Judgement examineMatrix(const std::vector<double>& a, int n, double friction, int pMatrixLimit) {
  const auto eigenvalues = symmetricEigenvalues(a, n);
  const double smallest = eigenvalues.front();
  if (positiveDefinite(eigenvalues))
    return {friction, smallest, "one solution", "the condensed matrix is positive definite"};
  const bool tested = n <= pMatrixLimit;
  if (tested && pMatrix(a, n))
    return {friction, smallest, "one solution", "the condensed matrix is a P-matrix"};
  const std::string notUnique =
      tested ? "no P-matrix: for some loads there is not exactly one solution"
             : "not positive definite";
  if (surelyCopositive(a, n))
    return {friction, smallest, "a solution exists",
            "the condensed matrix is strictly copositive, but " + notUnique};
  return {friction, smallest, "not decided", "the condensed matrix is " + notUnique};
}

double lossOfPositivity(double smallestRatio) {
  // Ratios are of the order of one, and known to the tolerance of the iterative solver at least.
  return smallestRatio < -1e-7 ? -1 / smallestRatio : std::numeric_limits<double>::infinity();
}

double lossOfPositivity(const std::vector<double>& a0, const std::vector<double>& a1, int size) {
  std::vector<double> s0 = symmetricPart(a0, size), s1 = symmetricPart(a1, size), values(size);
  PetscBLASInt n = size, length = 34 * n, info = 0;
  const PetscBLASInt type = 1;
  std::vector<double> work(length);
  LAPACKsygv_(&type, "N", "U", &n, s1.data(), &n, s0.data(), &n, values.data(), work.data(),
              &length, &info);
  if (info > n) return 0;
  if (info != 0)
    throw Error("LAPACK dsygv failed on the condensed matrix of the contact (info " +
                std::to_string(info) + ")");
  return lossOfPositivity(values.front());
}

}  // namespace squeal::steady
