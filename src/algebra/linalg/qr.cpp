// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/qr.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <string>

#include "algebra/linalg/lapack.hpp"
#include "base/petsc/check.hpp"

namespace squeal::linalg {

Qr::Qr(const DenseView& a) : q_(a), r_(a) {
  PetscBLASInt rows = a.rows(), columns = a.columns(), info = 0;
  std::vector<double> factors(columns);
  const auto requireSuccess = [&](const char* routine) {
    if (info != 0) throw Error(std::string("LAPACK ") + routine + " failed");
  };
  if (columns > 0)
    callWithWork([&](double* work, PetscBLASInt length) {
      LAPACKgeqrf_(&rows, &columns, r_.data(), &rows, factors.data(), work, &length, &info);
    });
  requireSuccess("dgeqrf");
  q_ = r_;
  q_.resizeColumns(rows);
  callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKorgqr_(&rows, &rows, &columns, q_.data(), &rows, factors.data(), work, &length, &info);
  });
  requireSuccess("dorgqr");
}

void Qr::divideByR(DenseMatrix& b) const {
  PetscBLASInt rows = b.rows(), columns = r_.columns(), stride = r_.rows();
  const double one = 1;
  if (rows == 0 || columns == 0) return;
  BLAStrsm_("R", "U", "N", "N", &rows, &columns, &one, r_.data(), &stride, b.data(), &rows);
}

DenseMatrix triangularFactor(DenseMatrix a) {
  PetscBLASInt rows = a.rows(), columns = a.columns(), info = 0;
  std::vector<double> factors(std::min(rows, columns));
  if (!a.empty())
    callWithWork([&](double* work, PetscBLASInt length) {
      LAPACKgeqrf_(&rows, &columns, a.data(), &rows, factors.data(), work, &length, &info);
    });
  if (info != 0) throw Error("LAPACK dgeqrf failed");
  DenseMatrix r(std::min(rows, columns), columns);
  for (PetscInt j = 0; j < columns; ++j)
    for (PetscInt i = 0; i <= std::min(j, r.rows() - 1); ++i) r(i, j) = a(i, j);
  return r;
}

}  // namespace squeal::linalg
