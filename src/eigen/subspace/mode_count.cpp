// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/subspace/mode_count.hpp"

#include <algorithm>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/symmetric.hpp"

namespace squeal::subspace {

using linalg::DenseMatrix;

namespace {

/// Returns the number of negative eigenvalues of a matrix that is symmetric within round-off.
int countNegative(const DenseMatrix& a) {
  const auto values = linalg::symmetricEigenvalues(linalg::symmetricPart(a));
  return std::ranges::count_if(values, [](double value) { return value < 0; });
}

}  // namespace

ModeCount::ModeCount(Basis& basis, const modes::Modes& modes, Mat mass)
    : lambda_(modes.lambda),
      complete_(modes.countConfirmed ? modes.inertiaShift : 0),
      stiffness_(basis.boundaryStiffness()) {
  const PetscInt boundary = basis.boundarySize(), count = std::ssize(lambda_);
  const auto constraint = basis.columns().columnRange(0, boundary),
             shapes = basis.columns().columnRange(boundary, boundary + count);
  linalg::Block inertia(basis.localRows());
  linalg::appendProduct(mass, constraint, inertia);
  mass_ = linalg::transposedProduct(basis.comm(), constraint, inertia);
  modal_ = linalg::transposedProduct(basis.comm(), shapes, inertia);  // of Φ Λ^(−½)
  basis.clearBoundary(inertia);
  rest_ = linalg::transposedProduct(basis.comm(), inertia, basis.responses(inertia));
  linalg::addScaled(rest_, -1, linalg::transposedProduct(modal_, modal_));
  for (PetscInt j = 0; j < boundary; ++j)
    for (PetscInt i = 0; i < count; ++i) modal_(i, j) *= modes.angularFrequency[i];
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
  const int bounds[] = {countNegative(std::move(least)), countNegative(std::move(most))};
  if (bounds[0] != bounds[1]) return {};
  return interior + bounds[0];
}

}  // namespace squeal::subspace
