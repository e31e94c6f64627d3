// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/complexdense.hpp"

#include <petscblaslapack.h>

#include <string>

#include "base/petsc/check.hpp"

// PETSc built with real scalars declares only the real routines.
extern "C" {
void zgemm_(const char* transA, const char* transB, const PetscBLASInt* m, const PetscBLASInt* n,
            const PetscBLASInt* k, const squeal::Complex* alpha, const squeal::Complex* a,
            const PetscBLASInt* lda, const squeal::Complex* b, const PetscBLASInt* ldb,
            const squeal::Complex* beta, squeal::Complex* c, const PetscBLASInt* ldc);
void zgeqrf_(const PetscBLASInt* m, const PetscBLASInt* n, squeal::Complex* a,
             const PetscBLASInt* lda, squeal::Complex* tau, squeal::Complex* work,
             const PetscBLASInt* length, PetscBLASInt* info);
void zungqr_(const PetscBLASInt* m, const PetscBLASInt* n, const PetscBLASInt* k,
             squeal::Complex* a, const PetscBLASInt* lda, const squeal::Complex* tau,
             squeal::Complex* work, const PetscBLASInt* length, PetscBLASInt* info);
void zgeev_(const char* left, const char* right, const PetscBLASInt* n, squeal::Complex* a,
            const PetscBLASInt* lda, squeal::Complex* values, squeal::Complex* vl,
            const PetscBLASInt* ldvl, squeal::Complex* vr, const PetscBLASInt* ldvr,
            squeal::Complex* work, const PetscBLASInt* length, double* realWork,
            PetscBLASInt* info);
}

namespace squeal::linalg {
namespace {

/// Calls a routine first for the length of its work array, and then with the array.
template <class Call>
void callWithComplexWork(const Call& call) {
  Complex wanted = 0;
  call(&wanted, -1);
  std::vector<Complex> work(static_cast<std::size_t>(wanted.real()));
  call(work.data(), static_cast<PetscBLASInt>(work.size()));
}

void requireSuccess(const char* routine, PetscBLASInt info) {
  if (info != 0)
    throw Error(std::string("LAPACK ") + routine + " failed on a small complex problem (info " +
                std::to_string(info) + ")");
}

ComplexMatrix multiplied(const char* sideOfX, PetscBLASInt rows, const ComplexMatrix& x,
                         const ComplexMatrix& y) {
  ComplexMatrix result(rows, y.columns());
  const PetscBLASInt columns = y.columns(), inner = y.rows(), ldx = x.rows();
  ensure((*sideOfX == 'N' ? x.columns() : x.rows()) == inner,
         "the inner sizes of a product are equal");
  const Complex one = 1, zero = 0;
  if (!result.empty() && inner > 0)
    zgemm_(sideOfX, "N", &rows, &columns, &inner, &one, x.data(), &ldx, y.data(), &inner, &zero,
           result.data(), &rows);
  return result;
}

}  // namespace

ComplexMatrix product(const DenseMatrix& a, const ComplexMatrix& x, bool transposed) {
  const PetscInt m = x.rows(), count = x.columns();
  if (a.empty()) return ComplexMatrix(m, count);
  ComplexMatrix result(transposed ? a.columns() : a.rows(), count);
  if (count == 0) return result;
  ensure((transposed ? a.rows() : a.columns()) == m, "a matrix has a column for each row of X");
  DenseMatrix parts(m, 2 * count);  // all real parts, then all imaginary ones
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < m; ++i) {
      parts(i, j) = x(i, j).real();
      parts(i, count + j) = x(i, j).imag();
    }
  const DenseMatrix made = transposed ? transposedProduct(a, parts) : product(a, parts);
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < result.rows(); ++i) result(i, j) = {made(i, j), made(i, count + j)};
  return result;
}

ComplexMatrix product(const ComplexMatrix& x, const ComplexMatrix& c) {
  return multiplied("N", x.rows(), x, c);
}

ComplexMatrix adjointProduct(const ComplexMatrix& x, const ComplexMatrix& y) {
  return multiplied("C", x.columns(), x, y);
}

void orthonormalise(ComplexMatrix& x) {
  const PetscBLASInt rows = x.rows(), columns = x.columns();
  if (columns == 0) return;
  PetscBLASInt info = 0;
  std::vector<Complex> tau(columns);
  callWithComplexWork([&](Complex* work, PetscBLASInt length) {
    zgeqrf_(&rows, &columns, x.data(), &rows, tau.data(), work, &length, &info);
  });
  requireSuccess("zgeqrf", info);
  callWithComplexWork([&](Complex* work, PetscBLASInt length) {
    zungqr_(&rows, &columns, &columns, x.data(), &rows, tau.data(), work, &length, &info);
  });
  requireSuccess("zungqr", info);
}

ComplexEigen eigen(ComplexMatrix a) {
  const PetscBLASInt n = a.rows();
  ComplexEigen result{std::vector<Complex>(n), ComplexMatrix(n, n), ComplexMatrix(n, n)};
  if (n == 0) return result;
  PetscBLASInt info = 0;
  std::vector<double> realWork(2 * static_cast<std::size_t>(n));
  callWithComplexWork([&](Complex* work, PetscBLASInt length) {
    zgeev_("V", "V", &n, a.data(), &n, result.value.data(), result.left.data(), &n,
           result.right.data(), &n, work, &length, realWork.data(), &info);
  });
  requireSuccess("zgeev", info);
  return result;
}

}  // namespace squeal::linalg
