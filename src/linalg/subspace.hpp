#pragma once
/// One or two eigenvalues of a dense quadratic problem and their invariant subspaces, from nearby
/// ones: one complex factorisation where all eigenvalues would take a hundred times as long.
#include "linalg/dense.hpp"

namespace squeal::linalg {

struct Cluster {
  std::complex<double> mean;
  std::vector<DensePair> pairs;  ///< with left vectors; nearly parallel where they meet
  bool converged = false;
};

/// Not collective. The subspaces of one or two pairs, begun with those of a neighbouring problem,
/// by inverse iteration with a fixed shift close to `guess`, the expected mean, on the companion
/// form A z = s B z from both sides. `isolation`: distance of the mean to the next eigenvalue, to
/// be known to within a factor of ten. Vectors of a smaller basis are continued by zeros.
Cluster clusterNear(const DenseProblem& problem, const std::vector<DensePair>& start,
                    std::complex<double> guess, double isolation);

/// Not collective. Eigenvalues and vectors of one problem, prepared for comparison with those of a
/// neighbouring one.
class Spectrum {
 public:
  /// Borrows nothing.
  Spectrum(const DenseProblem& problem, std::vector<DensePair> pairs);
  const std::vector<DensePair>& pairs() const { return pairs_; }
  /// yᴴ P′(s) x of pair i.
  std::complex<double> derivative(std::size_t i) const {
    return linear_ ? 2.0 * pairs_[i].s * own_[i] : own_[i];
  }
  bool damped() const { return !linear_; }  ///< the problem has a term in s
  /// tr(Π_i Π_j) of the spectral projectors of pair i here and pair j there: independent of the
  /// scaling of vectors, 1 for the same pair, 0 for another. Over all j it sums to 1; for groups of
  /// pairs the sum of all is the dimension that they share.
  std::complex<double> overlap(std::size_t i, const Spectrum& other, std::size_t j) const;

 private:
  std::complex<double> product(std::size_t i, const DensePair& pair) const;
  std::vector<DensePair> pairs_;
  bool linear_;                                          // in s²
  std::vector<std::vector<std::complex<double>>> rows_;  // [pair]: Mᵀ y, and after it (s M + Z)ᴴ y
  std::vector<std::complex<double>> own_;                // [pair]: product with itself
};

}  // namespace squeal::linalg
