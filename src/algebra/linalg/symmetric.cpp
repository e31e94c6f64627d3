// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/symmetric.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "algebra/linalg/lapack.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/log_events.hpp"

namespace squeal::linalg {
namespace {

/// Throws Error if a LAPACK routine has failed or returned NaN, which it does silently if the
/// matrix contains one.
void requireEigenvalues(const char* routine, PetscBLASInt info, const std::vector<double>& values) {
  const std::string of = std::to_string(values.size());
  if (info != 0)
    throw Error(std::string("LAPACK ") + routine + " failed on a matrix of order " + of +
                " (info " + std::to_string(info) + ")");
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    throw Error("a symmetric matrix of order " + of +
                " has an entry that is not finite or too large");
}

/// Calls a routine of LAPACK with real and integer work arrays, as
///   call(work, length, integerWork, integerLength),
/// first for the lengths.
template <class Call>
void callWithTwoWorks(const Call& call) {
  double wanted = 0;
  PetscBLASInt wantedIntegers = 0;
  call(&wanted, -1, &wantedIntegers, -1);
  std::vector<double> work(static_cast<std::size_t>(wanted));
  std::vector<PetscBLASInt> integers(wantedIntegers);
  call(work.data(), std::ssize(work), integers.data(), wantedIntegers);
}

/// Computes eigenvalues, and with the job "V" the vectors, which replace A. For some hundred
/// columns, divide and conquer is several times faster than dsyev, whose rotations (dlasr) are not
/// blocked.
std::vector<double> solve(const char* job, DenseMatrix& a) {
  ensure(a.rows() == a.columns(), "a symmetric matrix is square");
  PetscBLASInt order = a.rows(), info = 0;
  std::vector<double> values(order);
  if (order == 0) return values;
  const LoggedWork logged(Work::denseEigenvalues);
  callWithTwoWorks(
      [&](double* work, PetscBLASInt length, PetscBLASInt* integers, PetscBLASInt integerLength) {
        LAPACKsyevd_(job, "L", &order, a.data(), &order, values.data(), work, &length, integers,
                     &integerLength, &info);
      });
  requireEigenvalues("dsyevd", info, values);
  return values;
}

/// Does the same for A x = λ B x; a Cholesky factor replaces B.
std::vector<double> solve(const char* job, DenseMatrix& a, DenseMatrix& b) {
  ensure(a.rows() == a.columns() && b.rows() == a.rows() && b.columns() == a.rows(),
         "both matrices of an eigenproblem are square, of one order");
  PetscBLASInt type = 1, order = a.rows(), info = 0;
  std::vector<double> values(order);
  if (order == 0) return values;
  const LoggedWork logged(Work::denseEigenvalues);
  callWithTwoWorks(
      [&](double* work, PetscBLASInt length, PetscBLASInt* integers, PetscBLASInt integerLength) {
        LAPACKsygvd_(&type, job, "L", &order, a.data(), &order, b.data(), &order, values.data(),
                     work, &length, integers, &integerLength, &info);
      });
  requireEigenvalues("dsygvd", info, values);
  return values;
}

}  // namespace

DenseMatrix symmetricPart(const DenseView& a) {
  DenseMatrix s = transposed(a);
  const auto entries = a.entries();
  for (std::size_t i = 0; i < s.size(); ++i) s.data()[i] = 0.5 * (entries[i] + s.data()[i]);
  return s;
}

DenseMatrix choleskyFactor(DenseMatrix a) {
  PetscBLASInt n = a.rows(), info = 0;
  if (n > 0) LAPACKpotrf_("L", &n, a.data(), &n, &info);
  if (info != 0) throw Error("a matrix that should be positive definite is not");
  for (PetscInt j = 1; j < n; ++j) std::ranges::fill(a.column(j).first(j), 0.0);
  return a;
}

DenseMatrix inverseTransposed(const DenseMatrix& factor) {
  PetscBLASInt n = factor.rows();
  const PetscScalar one = 1;
  DenseMatrix result = identity(n);
  if (n > 0) BLAStrsm_("L", "L", "T", "N", &n, &n, &one, factor.data(), &n, result.data(), &n);
  return result;
}

int negativeEigenvalues(const DenseView& a) {
  DenseMatrix factors = symmetricPart(a);
  PetscBLASInt order = factors.rows(), info = 0;
  std::vector<PetscBLASInt> pivots(order);
  callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKsytrf_("L", &order, factors.data(), &order, pivots.data(), work, &length, &info);
  });
  if (info < 0) throw Error("LAPACK dsytrf failed");
  int count = 0;
  for (PetscInt i = 0; i < order; ++i) {
    if (pivots[i] > 0) {
      if (factors(i, i) < 0) ++count;
    } else {  // a block of order 2 has one
      ++count;
      ++i;
    }
  }
  return count;
}

std::vector<double> symmetricEigen(DenseMatrix& a) { return solve("V", a); }
std::vector<double> symmetricEigen(DenseMatrix& a, DenseMatrix& b) { return solve("V", a, b); }
std::vector<double> symmetricEigenvalues(DenseMatrix a) { return solve("N", a); }
std::vector<double> symmetricEigenvalues(DenseMatrix a, DenseMatrix b) { return solve("N", a, b); }

}  // namespace squeal::linalg
