#include "flutter/basis.hpp"

#include <cmath>
#include <vector>

#include "flutter/images.hpp"
#include "petsc/symmetric.hpp"

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

DenseMatrix Basis::gram(BV block, PetscInt count) const {
  const OwnedBV image = columnsLike(block, count);
  check(BVSetActiveColumns(block, 0, count));
  check(BVMatMult(block, mass_, image));
  const ReadColumns left(block), right(image);
  return transposedProduct(PetscObjectComm(reinterpret_cast<PetscObject>(block)), left.values(), left.rows(), count, right.values(),
                           count);
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

PetscInt Basis::add(BV block, PetscInt count, double dependent) {
  orthogonalise(block, count);
  normalise(block, count);
  // Eigenvectors of the Gram matrix give orthonormal combinations; small eigenvalues are combinations that depend on the others.
  // Once more for what rounding left.
  for (int pass = 0; pass < 2 && count > 0; ++pass) {
    if (pass > 0) orthogonalise(block, count);
    auto combinations = gram(block, count);
    const auto eigenvalues = symmetricEigen(combinations, static_cast<int>(count));
    PetscInt first = 0;
    while (first < count && !(eigenvalues[static_cast<std::size_t>(first)] > dependent * dependent * eigenvalues.back())) ++first;
    for (std::size_t k = 0; k < combinations.size(); ++k) {
      const auto j = k / static_cast<std::size_t>(count);
      combinations[k] *= static_cast<PetscInt>(j) < first ? 0 : 1 / std::sqrt(eigenvalues[j]);
    }
    OwnedMat products;
    check(MatCreateSeqDense(PETSC_COMM_SELF, count, count, combinations.data(), products.out()));
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
