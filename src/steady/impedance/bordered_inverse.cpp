// SPDX-License-Identifier: BSD-2-Clause
#include "steady/impedance/bordered_inverse.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/symmetric.hpp"

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
  // Scaled by the roots of the stiffnesses, the entries of D − Wᵀ B⁻¹ W have no unit. Those of
  // added unknowns are at most 1, and small if a body becomes nearly loose. Those of held unknowns
  // are at least 1, and large if a body of B is nearly loose.
  for (PetscInt j = 0; j < count; ++j) {
    scale_.push_back(added(j, j) > 0 ? 1 / std::sqrt(added(j, j)) : 0);
    for (double& entry : border_.column(j)) entry *= scale_[j];
  }
  for (PetscInt j = count; j < all; ++j) {
    const PetscInt i = held[j - count];
    scale_.push_back(std::sqrt(std::max(diagonal[i], 0.0)));
    border_(i, j) = scale_[j];
  }
  responses_ = border_;
  base.apply(responses_);
  DenseMatrix schur(all, all);
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < count; ++i) schur(i, j) = scale_[i] * scale_[j] * added(i, j);
  linalg::addScaled(schur, -1, linalg::transposedProduct(border_, responses_));
  vectors_ = linalg::symmetricPart(schur);
  values_ = linalg::symmetricEigen(vectors_);
  // If A and B are positive definite, each held unknown gives a negative eigenvalue, and each added
  // one a positive one (Haynsworth 1968).
  constexpr double small = 1e-8, large = 1e8;
  const PetscInt negative = std::ranges::count_if(values_, [](double v) { return v < 0; });
  isRegular_ = negative == std::ssize(held) && std::ranges::all_of(values_, [](double v) {
                 return std::abs(v) > small && std::abs(v) < large;
               });
}

void BorderedInverse::complete(DenseMatrix& x, DenseMatrix& c) const {
  if (values_.empty() || x.columns() == 0) return;
  DenseMatrix rest = linalg::transposedProduct(border_, x);
  for (PetscInt j = 0; j < rest.columns(); ++j)
    for (PetscInt i = 0; i < rest.rows(); ++i)
      rest(i, j) = (i < c.rows() ? scale_[i] * c(i, j) : 0) - rest(i, j);
  DenseMatrix parts = linalg::transposedProduct(vectors_, rest);
  for (PetscInt j = 0; j < parts.columns(); ++j)
    for (PetscInt i = 0; i < parts.rows(); ++i) parts(i, j) /= values_[i];
  const DenseMatrix y = linalg::product(vectors_, parts);
  linalg::multiplyAdd(responses_, y, x, -1);
  for (PetscInt j = 0; j < x.columns(); ++j) {
    for (const PetscInt i : held_) x(i, j) = 0;
    for (PetscInt i = 0; i < c.rows(); ++i) c(i, j) = scale_[i] * y(i, j);
  }
}

}  // namespace squeal::impedance
