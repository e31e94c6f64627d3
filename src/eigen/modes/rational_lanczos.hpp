// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Rational block Lanczos: a basis from solves with several shifted matrices (Ruhe 1984, 1998;
/// Grimes, Lewis and Simon 1994).
#include <array>
#include <functional>
#include <random>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::modes {

/// A pole σ of the rational functions that generate the basis. The first pole is σ0.
struct Pole {
  double distance;  ///< δ = σ − σ0
  /// Collective. Computes X = (K − σ M)⁻¹ B, both n × b.
  std::function<void(Mat b, Mat x)> solve;
};

/// Ritz pairs of S = (K − σ0 M)⁻¹ M in a basis V of k vectors.
struct RitzPairs {
  std::vector<double> value;     ///< θ, descending
  std::vector<double> residual;  ///< ‖S x − θ x‖_M
  /// [k × k]: coordinates of the M-orthonormal Ritz vectors x, followed by those of b directions
  /// that are M-orthogonal to all x and span their residuals.
  linalg::DenseMatrix vectors;
  linalg::DenseMatrix coupling;  ///< [b × pairs] coordinates of the residuals in these directions
};

/// A growing M-orthonormal basis V. A step from its last block V_l,
///   W = (K − σ M)⁻¹ M V_l = V h + Q R,
/// appends Q. In terms of S,
///   S (V_l + δ W) = W,
/// so all steps together satisfy S V A = V B for any poles, with small matrices A and B that have b
/// more rows than columns. The Rayleigh–Ritz method is applied to the range of V A, where residuals
/// are known without further solves. With δ = 0 this is block Lanczos with full orthogonalisation
/// and thick restart (Golub and Underwood 1977; Wu and Simon 2000).
class RationalLanczos {
 public:
  /// Collective. During the lifetime of the object, borrows M, symmetric positive definite, and the
  /// columns of a BV of type svec, which it fills. `blockSize` is b.
  RationalLanczos(Mat m, BV basis, PetscInt blockSize);
  ~RationalLanczos() { BVRestoreArray(basis_, &columns_); }
  RationalLanczos(const RationalLanczos&) = delete;
  RationalLanczos& operator=(const RationalLanczos&) = delete;

  PetscInt size() const { return size_; }  ///< k, number of vectors of V
  bool full() const { return size_ + width_ > limit_; }
  int solves() const { return solves_; }  ///< number of right-hand sides
  /// Collective. Creates the first block by applying S to a random one, which damps components of
  /// high frequency. The pole must be σ0.
  void start(const Pole& pole);
  /// Collective. Appends a block by a step with this pole. Throws Error if the basis cannot be
  /// extended.
  void expand(const Pole& pole);
  /// Collective. Returns k − b Ritz pairs, the same on all ranks.
  RitzPairs ritz() const;
  /// Collective. Replaces V by the first `kept` Ritz vectors and the directions that span the
  /// residuals.
  void restart(const RitzPairs& ritz, PetscInt kept);
  /// Collective. Replaces V by the first `count` Ritz vectors, in the first columns of the BV.
  void finish(const RitzPairs& ritz, PetscInt count);

 private:
  linalg::DenseView columnRange(PetscInt first, PetscInt last) const;
  void massTimesW();
  void solve(const Pole& pole);
  linalg::DenseMatrix timesMassTimesW(const linalg::DenseView& x) const;
  void subtract(linalg::DenseMatrix& sum);
  void subtractLastTwo(linalg::DenseMatrix& sum);
  linalg::DenseMatrix orthogonalise(bool recurrence);
  void orthonormalise(double size);
  void refill(const std::vector<bool>& lost);
  void append();
  void rotate(const linalg::DenseMatrix& combinations);

  Mat m_;
  BV basis_;
  MPI_Comm comm_;
  PetscInt width_, limit_ = 0, rows_ = 0, unknowns_ = 0, size_ = 0;  // width_ is b
  int solves_ = 0;
  PetscScalar* columns_ = nullptr;           // of V
  int sinceChange_ = 0;                      // steps since the last restart or change of the pole
  double distance_ = 0;                      // of the last pole
  bool massIsOfLast_ = false;                // M W is M times the last block
  linalg::Block w_, mw_;                     // W and M W
  std::array<linalg::Block, 2> massOfLast_;  // M times the last two blocks of V
  std::vector<bool> foreign_;      // [column of A] true: from a step with a pole other than σ0
  linalg::DenseMatrix a_, b_, r_;  // A, B and the last R
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

}  // namespace squeal::modes
