// SPDX-License-Identifier: BSD-2-Clause
#include "steady/impedance/bordered_inverse.hpp"

namespace squeal::impedance {

using linalg::DenseMatrix;

BorderedInverse::BorderedInverse(const SymmetricInverse& base, const std::vector<double>& diagonal,
                                 DenseMatrix coupling, const DenseMatrix& added,
                                 const std::vector<PetscInt>& held)
    : border_(std::move(coupling)), held_(held) {
  const PetscInt count = border_.columns(), all = count + std::ssize(held);
  if (all == 0) return;
  if (count == 0) border_ = DenseMatrix(std::ssize(diagonal));
  border_.resizeColumns(all);
  // With unit vectors of the size of a stiffness, so are all pivots.
  for (PetscInt k = count; k < all; ++k) border_(held[k - count], k) = diagonal[held[k - count]];
  responses_ = border_;
  base.apply(responses_);
  DenseMatrix schur(all, all);
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < count; ++i) schur(i, j) = 0.5 * (added(i, j) + added(j, i));
  linalg::addScaled(schur, -1, linalg::transposedProduct(border_, responses_));
  schur_.emplace(std::move(schur));
}

bool BorderedInverse::isRegular() const {
  constexpr double singular = 1e-12;
  return !schur_ || schur_->pivotRatio() > singular;
}

void BorderedInverse::complete(DenseMatrix& x, DenseMatrix& c) const {
  if (!schur_ || x.columns() == 0) return;
  DenseMatrix y = linalg::transposedProduct(border_, x);
  for (PetscInt j = 0; j < y.columns(); ++j)
    for (PetscInt i = 0; i < y.rows(); ++i) y(i, j) = (i < c.rows() ? c(i, j) : 0) - y(i, j);
  schur_->solve(y);
  linalg::multiplyAdd(responses_, y, x, -1);
  for (PetscInt j = 0; j < x.columns(); ++j) {
    for (const PetscInt i : held_) x(i, j) = 0;
    for (PetscInt i = 0; i < c.rows(); ++i) c(i, j) = y(i, j);
  }
}

}  // namespace squeal::impedance
