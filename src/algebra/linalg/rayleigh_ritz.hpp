// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Continuation of one or two eigenvalues of a dense quadratic problem, with their invariant
/// subspace, from a neighbouring problem, and comparison of the eigenvectors of two problems. The
/// continuation takes one to three factorisations; computing all eigenvalues would take as long as
/// a hundred factorisations.
#include "algebra/linalg/quadratic.hpp"

namespace squeal::linalg {

/// One or two eigenvalues of one invariant subspace.
struct Cluster {
  Complex mean;  ///< mean of the eigenvalues, 1/s
  /// The eigenvalues with their right and left vectors. If two eigenvalues nearly coincide, their
  /// vectors are nearly parallel.
  std::vector<DensePair> pairs;
  bool converged = false;
};

/// Not collective. Finds the one or two eigenvalues that continue those of `start`, the pairs of a
/// neighbouring problem with right and left vectors. The method is two-sided inverse iteration on
/// the companion form
///   A z = s B z,   A = [0 I; −K −Z],   B = [I 0; 0 M].
/// The shift is fixed for each factorisation; the first one is near `guess`, the expected mean.
/// `isolation` is an estimate, within a factor of ten, of the distance from the mean to the next
/// eigenvalue, in 1/s. If `start` belongs to a smaller basis, its vectors are extended by zeros.
/// The result has converged = false if the iteration does not converge or P(shift) is singular.
Cluster clusterNear(const DenseProblem& problem, const std::vector<DensePair>& start, Complex guess,
                    double isolation);

/// Eigenvalues of one problem with left and right vectors, prepared for comparison with a
/// neighbouring problem. Not collective.
class Spectrum {
 public:
  /// Borrows the problem only during this call. Takes the pairs, which must have left vectors.
  Spectrum(const DenseProblem& problem, std::vector<DensePair> pairs);
  const std::vector<DensePair>& pairs() const { return pairs_; }
  /// Returns yᴴ P′(s) x of pair i, with P′ = 2 s M + Z.
  Complex derivative(std::size_t i) const {
    return linear_ ? 2.0 * pairs_[i].s * own_[i] : own_[i];
  }
  bool damped() const { return !linear_; }  ///< the problem has a term in s
  /// Returns tr(Π_i Π_j) [M.41], the trace of the product of two spectral projectors: Π_i of pair i
  /// of this problem and Π_j of pair j of the other. It does not depend on the scaling of the
  /// vectors. It is 1 for the same pair and 0 for different ones. Its sum over all j is 1. Its sum
  /// over all i of one group and all j of another is the dimension of the subspace that the two
  /// groups share.
  Complex overlap(std::size_t i, const Spectrum& other, std::size_t j) const;
  /// Returns all overlaps, pairs × pairs of `other`.
  ComplexMatrix overlaps(const Spectrum& other) const;

 private:
  Complex product(std::size_t i, const DensePair& pair) const;
  ComplexMatrix products(const std::vector<DensePair>& pairs) const;
  std::vector<DensePair> pairs_;
  bool linear_;                             // true if the problem is linear in s²
  std::vector<std::vector<Complex>> rows_;  // [pair]: Mᵀ y, then (s M + Z)ᴴ y
  std::vector<Complex> own_;                // [pair]: product(i, pair i)
};

}  // namespace squeal::linalg
