// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The part of a field that functions explain, in a weighted least-squares fit. Not collective.
#include <span>
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::energies {

/// Fits of functions p_k with the Gram matrix G_kl = Σ w p_k p_l. A field u with b_k = Σ w p_k u is
/// explained by u ≈ Σ c_k p_k, G c = b, and cᵀ b of Σ w u² is the explained part. Directions in
/// which G is below 1e-9 of its largest eigenvalue are left out: there the functions are dependent.
class WeightedFit {
 public:
  WeightedFit() = default;
  /// Takes G, of which it reads the lower triangle. Throws Error if its eigenvalues are not finite.
  explicit WeightedFit(linalg::DenseMatrix gram);
  /// Returns c.
  std::vector<double> coefficients(std::span<const double> b) const;
  /// Returns cᵀ b.
  double explained(std::span<const double> b) const;

 private:
  linalg::DenseMatrix vectors_;
  std::vector<double> values_;  // 0: left out
};

}  // namespace squeal::energies
