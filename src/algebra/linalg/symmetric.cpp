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

}  // namespace

DenseMatrix symmetricPart(const DenseView& a) {
  DenseMatrix s(a.rows(), a.columns());
  for (PetscInt j = 0; j < a.columns(); ++j)
    for (PetscInt i = 0; i < a.rows(); ++i) s(i, j) = 0.5 * (a(i, j) + a(j, i));
  return s;
}

std::vector<double> symmetricEigen(DenseMatrix& a) {
  ensure(a.rows() == a.columns(), "a symmetric matrix is square");
  PetscBLASInt order = a.rows(), length = -1, integers = -1, info = 0, integerLength = 0;
  std::vector<double> values(order);
  if (order == 0) return values;
  const LoggedWork logged(Work::denseEigenvalues);
  double workLength = 0;
  // For some hundred columns, divide and conquer is several times faster than dsyev, whose
  // rotations (dlasr) are not blocked.
  LAPACKsyevd_("V", "L", &order, a.data(), &order, values.data(), &workLength, &length,
               &integerLength, &integers, &info);
  length = workLength;
  integers = integerLength;
  std::vector<double> work(length);
  std::vector<PetscBLASInt> integerWork(integers);
  LAPACKsyevd_("V", "L", &order, a.data(), &order, values.data(), work.data(), &length,
               integerWork.data(), &integers, &info);
  requireEigenvalues("dsyevd", info, values);
  return values;
}

std::vector<double> symmetricEigen(DenseMatrix& a, DenseMatrix& b) {
  ensure(a.rows() == a.columns() && b.rows() == a.rows() && b.columns() == a.rows(),
         "both matrices of an eigenproblem are square, of one order");
  PetscBLASInt type = 1, order = a.rows(), info = 0;
  std::vector<double> values(order);
  if (order == 0) return values;
  const LoggedWork logged(Work::denseEigenvalues);
  callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKsygv_(&type, "V", "L", &order, a.data(), &order, b.data(), &order, values.data(), work,
                &length, &info);
  });
  requireEigenvalues("dsygv", info, values);
  return values;
}

}  // namespace squeal::linalg
