#pragma once
/// The friction-perturbed problem P(s; f) d = 0 as one affine object, P = Σ_t c_t(f) s^p_t A_t with c_t(f) = factor · f^a. It
/// knows nothing of finite elements: [4.15–4.16] enter as terms.
#include <complex>
#include <vector>

#include "petsc/owned.hpp"

namespace squeal::flutter {

struct Term {
  OwnedMat matrix;           ///< n×n
  int power = 0;             ///< of s: 0 stiffness, 1 damping, 2 mass
  int frictionExponent = 0;  ///< a
  double factor = 1;

  double coefficient(double friction) const;
};

class Pencil {
 public:
  explicit Pencil(std::vector<Term> terms) : terms_(std::move(terms)) {}
  const std::vector<Term>& terms() const { return terms_; }
  bool hasPower(int power) const;
  MPI_Comm comm() const;

  /// Collective. Sum of the terms with this power of s at this friction, as a new matrix.
  OwnedMat assembled(int power, double friction) const;
  /// Collective. y = (sum of the terms with this power) x.
  void apply(int power, double friction, Vec x, Vec y) const;
  /// Collective. Estimate from below of the 2-norm of the sum, by power iteration on AᵀA continued from the last call for this
  /// power: from below, so that a backward error made with it is never flattered.
  double norm(int power, double friction) const;

 private:
  std::vector<Term> terms_;
  mutable OwnedVec singular_[3];
};

/// Collective. ‖P(s) d‖ / ((|s|² ‖M̄‖ + |s| ‖Z̄‖ + ‖K̄‖) ‖d‖) for d = real + i imaginary (imaginary may be null).
double backwardError(const Pencil& pencil, double friction, std::complex<double> s, Vec real, Vec imaginary);

}  // namespace squeal::flutter
