// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Weighted least-squares fits of a field by functions. Not collective.
#include <span>
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::energies {

/// Fits by functions p_k with the Gram matrix G_kl = Σ w p_k p_l and the weights w. For a field u
/// with b_k = Σ w p_k u, the fit is u ≈ Σ c_k p_k with G c = b. It explains the part cᵀ b of Σ w
/// u². Directions in which G is below 1e-9 of its largest eigenvalue are omitted, since the
/// functions are dependent there.
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
