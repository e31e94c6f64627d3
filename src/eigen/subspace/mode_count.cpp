// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/subspace/mode_count.hpp"

#include <algorithm>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/symmetric.hpp"

namespace squeal::subspace {

using linalg::DenseMatrix;

ModeCount::ModeCount(const Basis& basis, const modes::Modes& modes, const DenseMatrix& mass)
    : lambda_(modes.lambda),
      complete_(modes.countConfirmed ? modes.inertiaShift : 0),
      stiffness_(basis.boundaryStiffness()) {
  const PetscInt boundary = basis.boundarySize(), count = std::ssize(lambda_);
  mass_ = linalg::rowRange(mass.columnRange(0, boundary), 0, boundary);
  modal_ = linalg::rowRange(mass.columnRange(0, boundary), boundary, boundary + count);
  for (PetscInt j = 0; j < boundary; ++j)  // the vectors in V are Φ Λ^(−½)
    for (PetscInt i = 0; i < count; ++i) modal_(i, j) *= modes.angularFrequency[i];
  isSharp_ = complete_ == 0;  // nothing is known
  if (isSharp_) return;
  linalg::addScaled(rest_, 1 / complete_, mass_);
  linalg::addScaled(rest_, -1 / complete_, linalg::transposedProduct(modal_, modal_));
}

void ModeCount::sharpen(Basis& basis, Mat mass) {
  const PetscInt boundary = basis.boundarySize();
  linalg::Block inertia(basis.localRows());
  basis.appendProducts(mass, 0, boundary, inertia);
  basis.clearBoundary(inertia);
  rest_ = basis.flexibility(inertia);
  DenseMatrix scaled = modal_;
  for (PetscInt j = 0; j < boundary; ++j)
    for (PetscInt i = 0; i < scaled.rows(); ++i) scaled(i, j) /= lambda_[i];
  linalg::addScaled(rest_, -1, linalg::transposedProduct(modal_, scaled));
  isSharp_ = true;
}

std::optional<int> ModeCount::below(double sigma, const std::vector<PetscInt>& own) const {
  if (!(sigma < complete_)) return {};
  const PetscInt n = std::ssize(own), count = std::ssize(lambda_);
  const int interior = std::ranges::count_if(lambda_, [&](double value) { return value < sigma; });
  if (n == 0) return interior;
  DenseMatrix least(n, n), scaled(count, n), modal(count, n);
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < count; ++i) {
      modal(i, j) = modal_(i, own[j]);
      scaled(i, j) = modal(i, j) / (lambda_[i] - sigma);
    }
  linalg::addScaled(least, -sigma * sigma, linalg::transposedProduct(modal, scaled));
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < n; ++i)
      least(i, j) += stiffness_(own[i], own[j]) - sigma * mass_(own[i], own[j]);
  DenseMatrix most = least;
  const double factor = sigma * sigma / (1 - sigma / complete_);
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < n; ++i) most(i, j) -= factor * rest_(own[i], own[j]);
  const int bounds[] = {linalg::negativeEigenvalues(least), linalg::negativeEigenvalues(most)};
  if (bounds[0] != bounds[1]) return {};
  return interior + bounds[0];
}

}  // namespace squeal::subspace
