#include "flutter/basis.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <cmath>
#include <vector>

namespace squeal::flutter {

OwnedBV columnsLike(BV like, PetscInt columns) {
  OwnedBV bv;
  PetscInt local = 0, global = 0;
  check(BVGetSizes(like, &local, &global, nullptr));
  check(BVCreate(PetscObjectComm(reinterpret_cast<PetscObject>(like)), bv.out()));
  check(BVSetSizes(bv, local, global, columns));
  check(BVSetType(bv, BVSVEC));
  return bv;
}

Basis::Basis(BV start, Mat mass) : mass_(mass) {
  check(BVGetSizes(start, nullptr, nullptr, &size_));
  columns_ = columnsLike(start, size_);
  check(BVCopy(start, columns_));
}

OwnedMat Basis::gram(BV block, PetscInt count) const {
  OwnedMat result;
  const OwnedBV image = columnsLike(block, count);
  check(BVSetActiveColumns(block, 0, count));
  check(BVMatMult(block, mass_, image));
  check(MatCreateSeqDense(PETSC_COMM_SELF, count, count, nullptr, result.out()));
  check(BVDot(image, block, result));
  return result;
}

/// Unit columns, so that "dependent" means the same for all; a column that is zero stays so.
void Basis::normalise(BV block, PetscInt count) {
  for (PetscInt j = 0; j < count; ++j) {
    Vec column = nullptr;
    check(BVGetColumn(block, j, &column));
    check(VecNormalize(column, nullptr));
    check(BVRestoreColumn(block, j, &column));
  }
}

/// block ← block − V (Vᵀ M block), twice.
void Basis::orthogonalise(BV block, PetscInt count) {
  const OwnedBV image = columnsLike(block, count);
  OwnedMat coefficients;
  check(MatCreateSeqDense(PETSC_COMM_SELF, size_, count, nullptr, coefficients.out()));
  check(BVSetActiveColumns(block, 0, count));
  for (int pass = 0; pass < 2; ++pass) {
    check(BVMatMult(block, mass_, image));
    check(BVDot(image, columns_, coefficients));
    check(BVMult(block, -1, 1, columns_, coefficients));
  }
}

/// Eigenvalues (ascending) and eigenvectors (columns, in place) of a symmetric matrix.
std::vector<double> Basis::symmetricEigen(Mat matrix) {
  PetscInt size = 0;
  PetscScalar* values = nullptr;
  check(MatGetSize(matrix, &size, nullptr));
  check(MatDenseGetArray(matrix, &values));
  std::vector<double> eigenvalues(static_cast<std::size_t>(size)), work(1);
  PetscBLASInt n = static_cast<PetscBLASInt>(size), length = -1, info = 0;
  LAPACKsyev_("V", "L", &n, values, &n, eigenvalues.data(), work.data(), &length, &info);
  length = static_cast<PetscBLASInt>(work[0]);
  work.resize(static_cast<std::size_t>(length));
  LAPACKsyev_("V", "L", &n, values, &n, eigenvalues.data(), work.data(), &length, &info);
  check(MatDenseRestoreArray(matrix, &values));
  if (info != 0) check(PETSC_ERR_LIB);
  return eigenvalues;
}

PetscInt Basis::add(BV block, PetscInt count, double dependent) {
  orthogonalise(block, count);
  normalise(block, count);
  // Eigenvectors of the Gram matrix give orthonormal combinations; small eigenvalues are combinations that depend on the others.
  // Once more for what rounding left.
  for (int pass = 0; pass < 2 && count > 0; ++pass) {
    if (pass > 0) orthogonalise(block, count);
    const OwnedMat products = gram(block, count);
    const auto eigenvalues = symmetricEigen(products);
    PetscInt first = 0;
    while (first < count && !(eigenvalues[static_cast<std::size_t>(first)] > dependent * dependent * eigenvalues.back())) ++first;
    for (PetscInt j = 0; j < count; ++j) {
      PetscScalar* column = nullptr;
      check(MatDenseGetColumn(products, j, &column));
      for (PetscInt i = 0; i < count; ++i) column[i] *= j < first ? 0 : 1 / std::sqrt(eigenvalues[static_cast<std::size_t>(j)]);
      check(MatDenseRestoreColumn(products, &column));
    }
    check(BVSetActiveColumns(block, 0, count));
    check(BVMultInPlace(block, products, 0, count));
    // The columns worth keeping are the last ones; move them to the front.
    for (PetscInt j = first; j < count && first > 0; ++j) check(BVCopyColumn(block, j, j - first));
    count -= first;
  }
  if (count == 0) return 0;
  const PetscInt kept = count;
  check(BVResize(columns_, size_ + kept, PETSC_TRUE));
  check(BVSetActiveColumns(block, 0, kept));
  check(BVSetActiveColumns(columns_, size_, size_ + kept));
  check(BVCopy(block, columns_));
  size_ += kept;
  check(BVSetActiveColumns(columns_, 0, size_));
  return kept;
}

}  // namespace squeal::flutter
