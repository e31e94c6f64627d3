// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Weighted least-squares fits of a field by functions. Not collective.
#include <span>
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::energies {

/// Fits a field u by functions p_k with weights w and the Gram matrix G:
///   u ≈ Σ c_k p_k,   G c = b,   G_kl = Σ w p_k p_l,   b_k = Σ w p_k u.
/// The fit explains the part cᵀ b of Σ w u². Eigenvectors of G with eigenvalues of at most 1e-9 of
/// the largest are omitted, since the functions are linearly dependent in these directions.
class WeightedFit {
 public:
  WeightedFit() = default;
  /// Takes G and reads only its lower triangle. Throws Error if the eigenvalues of G are not
  /// finite.
  explicit WeightedFit(linalg::DenseMatrix gram);
  /// Returns c.
  std::vector<double> coefficients(std::span<const double> b) const;
  /// Returns cᵀ b.
  double explained(std::span<const double> b) const;

 private:
  linalg::DenseMatrix vectors_;
  std::vector<double> values_;  // eigenvalues; 0: omitted
};

}  // namespace squeal::energies
