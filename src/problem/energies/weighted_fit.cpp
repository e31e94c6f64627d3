// SPDX-License-Identifier: BSD-2-Clause
#include "problem/energies/weighted_fit.hpp"

#include "algebra/linalg/symmetric.hpp"

namespace squeal::energies {

WeightedFit::WeightedFit(linalg::DenseMatrix gram) : vectors_(std::move(gram)) {
  values_ = linalg::symmetricEigen(vectors_);
  if (values_.empty()) return;
  const double least = 1e-9 * values_.back();
  for (double& value : values_)
    if (value <= least) value = 0;
}

std::vector<double> WeightedFit::coefficients(std::span<const double> b) const {
  std::vector<double> c(b.size(), 0.0);
  for (std::size_t j = 0; j < values_.size(); ++j) {
    if (values_[j] == 0) continue;
    double along = 0;
    for (std::size_t i = 0; i < b.size(); ++i) along += vectors_(i, j) * b[i];
    for (std::size_t i = 0; i < b.size(); ++i) c[i] += vectors_(i, j) * along / values_[j];
  }
  return c;
}

double WeightedFit::explained(std::span<const double> b) const {
  double sum = 0;
  for (std::size_t j = 0; j < values_.size(); ++j) {
    if (values_[j] == 0) continue;
    double along = 0;
    for (std::size_t i = 0; i < b.size(); ++i) along += vectors_(i, j) * b[i];
    sum += along * along / values_[j];
  }
  return sum;
}

}  // namespace squeal::energies
