// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/qr.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <algorithm>
#include <string>

#include "algebra/linalg/lapack.hpp"
#include "base/petsc/check.hpp"

namespace squeal::linalg {

namespace {

void requireSuccess(const char* routine, PetscBLASInt info) {
  if (info != 0) throw Error(std::string("LAPACK ") + routine + " failed");
}

/// Replaces A by its factors, whose scalars are returned.
std::vector<double> factorise(DenseMatrix& a) {
  PetscBLASInt rows = a.rows(), columns = a.columns(), info = 0;
  std::vector<double> scalars(std::min(rows, columns));
  if (!a.empty())
    callWithWork([&](double* work, PetscBLASInt length) {
      LAPACKgeqrf_(&rows, &columns, a.data(), &rows, scalars.data(), work, &length, &info);
    });
  requireSuccess("dgeqrf", info);
  return scalars;
}

/// Replaces the factors by the first columns of Q, as many as the matrix has.
void expandQ(DenseMatrix& factors, std::vector<double>& scalars) {
  PetscBLASInt rows = factors.rows(), columns = factors.columns(), count = scalars.size(), info = 0;
  callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKorgqr_(&rows, &columns, &count, factors.data(), &rows, scalars.data(), work, &length,
                 &info);
  });
  requireSuccess("dorgqr", info);
}

}  // namespace

Qr::Qr(const DenseView& a) : r_(a) {
  auto scalars = factorise(r_);
  q_ = r_;
  q_.resizeColumns(a.rows());
  expandQ(q_, scalars);
}

void Qr::divideByR(DenseMatrix& b) const {
  PetscBLASInt rows = b.rows(), columns = r_.columns(), stride = r_.rows();
  const double one = 1;
  if (rows == 0 || columns == 0) return;
  BLAStrsm_("R", "U", "N", "N", &rows, &columns, &one, r_.data(), &stride, b.data(), &rows);
}

void orthonormalise(DenseMatrix& x) {
  if (x.columns() == 0) return;
  auto scalars = factorise(x);
  expandQ(x, scalars);
}

DenseMatrix triangularFactor(DenseMatrix a) {
  factorise(a);
  DenseMatrix r(std::min(a.rows(), a.columns()), a.columns());
  for (PetscInt j = 0; j < r.columns(); ++j)
    for (PetscInt i = 0; i <= std::min(j, r.rows() - 1); ++i) r(i, j) = a(i, j);
  return r;
}

}  // namespace squeal::linalg
