// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bounds of sparse matrices on the space C that V leaves out (kept.hpp), each confirmed by the
/// inertia of a sparse matrix.
#include <utility>
#include <vector>

#include "algebra/factor/associated_system.hpp"

namespace squeal::proof {

/// Bounds relative to the energy K0. On C, M ≤ `mass`, so that H = K0 + M / mass ≤ 2 and every
/// A ≤ g H is at most 2 g. To confirm g, the program computes the inertia of g H − A, or of
/// [g H, A; Aᵀ, g H] for an antisymmetric A. The confirmed g is less than 1.2 times the smallest
/// possible one, or so small that it hardly affects δ.
class MatrixBounds {
 public:
  /// Collective. Estimates the norms of these matrices, which are borrowed during the life of the
  /// object. Null handles stand for zero. All have the rows of K0.
  MatrixBounds(const factor::AssociatedSystem& system, double mass, std::vector<Mat> matrices);

  /// The following functions are collective. They take one of the matrices, and throw Error if no
  /// bound is confirmed. `weight` is the factor with which the bound reduces δ.

  /// Return a bound of ‖A‖ for an antisymmetric or a symmetric A.
  double ofSkew(Mat matrix, double weight) const;
  double ofSymmetric(Mat matrix, double weight) const;
  /// Bounds of a symmetric A that is positive semi-definite except for round-off or a small part:
  /// 0 ≤ A + κ H ≤ `whole` on C, with ‖κ H‖ ≤ `below`.
  struct Damping {
    double whole = 0, below = 0;
  };
  Damping ofDamping(Mat matrix, double weight, double weightBelow) const;

 private:
  double likely(Mat matrix) const;
  OwnedMat energy_;  // H
  std::vector<std::pair<Mat, double>> likely_;
};

}  // namespace squeal::proof
