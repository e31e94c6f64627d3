// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Continuation of one or two eigenvalues of a dense quadratic problem, with their invariant
/// subspace, from a neighbouring problem. It takes one to three factorisations; all eigenvalues
/// would take a hundred times as long as one factorisation.
#include "algebra/linalg/quadratic.hpp"

namespace squeal::linalg {

/// One or two eigenvalues of one invariant subspace.
struct Cluster {
  Complex mean;                  ///< mean of the eigenvalues, 1/s
  std::vector<DensePair> pairs;  ///< with left vectors; nearly parallel where eigenvalues meet
  bool converged = false;
};

/// Not collective. Finds the one or two eigenvalues that continue `start`, pairs of a neighbouring
/// problem with both vectors, by two-sided inverse iteration on the companion form
///   A z = s B z,   A = [0 I; −K −Z],   B = [I 0; 0 M].
/// The shift is fixed within a factorisation, near `guess`, the expected mean. `isolation` is the
/// distance of the mean from the next eigenvalue, in 1/s, within a factor of ten. Vectors of a
/// smaller basis are extended by zeros. The result has converged = false if the iteration does not
/// converge or P(shift) is singular.
Cluster clusterNear(const DenseProblem& problem, const std::vector<DensePair>& start, Complex guess,
                    double isolation);

/// Eigenvalues of one problem with left and right vectors, prepared for comparison with a
/// neighbouring problem. Not collective.
class Spectrum {
 public:
  /// Reads the problem only during this call, and takes the pairs, with their left vectors.
  Spectrum(const DenseProblem& problem, std::vector<DensePair> pairs);
  const std::vector<DensePair>& pairs() const { return pairs_; }
  /// Returns yᴴ P′(s) x of pair i, with P′ = 2 s M + Z.
  Complex derivative(std::size_t i) const {
    return linear_ ? 2.0 * pairs_[i].s * own_[i] : own_[i];
  }
  bool damped() const { return !linear_; }  ///< the problem has a term in s
  /// Returns the trace of the product of two spectral projectors, tr(Π_i Π_j) [M.41], of pair i of
  /// this problem and pair j of the other. It does not depend on the scaling of the vectors. It is
  /// 1 for the same pair and 0 for different ones. Its sum over all j is 1. Its sum over two groups
  /// of pairs is the dimension of their common subspace.
  Complex overlap(std::size_t i, const Spectrum& other, std::size_t j) const;

 private:
  Complex product(std::size_t i, const DensePair& pair) const;
  std::vector<DensePair> pairs_;
  bool linear_;                             // true if the problem is linear in s²
  std::vector<std::vector<Complex>> rows_;  // [pair]: Mᵀ y, then (s M + Z)ᴴ y
  std::vector<Complex> own_;                // [pair]: product(i, pair i)
};

}  // namespace squeal::linalg
