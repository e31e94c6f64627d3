// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The problem P_VV on V (kept.hpp) in coordinates in which it is nearly diagonal, so that its
/// inverse is known at every s.
#include <vector>

#include "algebra/linalg/complexdense.hpp"
#include "eigen/proof/conjugate_pairs.hpp"
#include "eigen/proof/kept.hpp"

namespace squeal::proof {

/// The pencil
///   Y L(z) X = D(z) + Δ(z),   D(z) = 1 + (z − 1) diag(ν),
/// with z = s / top and L the linearised P_VV, or z = (s / top)² and L = P_VV if neither P_VV nor
/// the couplings have odd powers of s. L has the eigenvalues of P_VV with their multiplicities. The
/// majorants F and E of the couplings give
///   F(s) P_VV(s)⁻¹ E(s) = a(z) (D(z) + Δ(z))⁻¹ b(z)
/// with polynomials a and b. X and Y come from LAPACK and need not be accurate: Δ is computed from
/// them as they are, and so contains their errors. Not collective.
class DiagonalForm {
 public:
  /// Computes the form for regions with tops near `top`, rad/s. Throws Error if LAPACK fails.
  DiagonalForm(const KeptProblem& problem, double top);

  /// Returns false if P_VV(top) is singular, or if Δ is not small.
  bool regular() const { return regular_; }
  double top() const { return top_; }
  /// The bounds of the couplings hold for |z| up to this.
  double reach() const { return reach_; }
  bool squared() const { return squared_; }
  PetscInt size() const { return std::ssize(nu_); }  ///< N, or 2 N if not squared
  std::span<const Complex> nu() const { return nu_; }

  /// Returns the eigenvalues in the plane of z, in the order of ν. Some may be infinite.
  std::vector<Complex> eigenvaluesInPlane() const;
  /// Returns the finite eigenvalues s, rad/s; if squared, both s and −s for each z.
  std::vector<Complex> eigenvalues() const;
  /// Returns the z of an s.
  Complex inPlane(Complex s) const { return squared_ ? s * s / (top_ * top_) : s / top_; }
  /// Returns the s of a z, with Im s ≥ 0 if squared.
  Complex outOfPlane(Complex z) const;

  /// Returns which of the ν, with their vectors, form pairs of conjugates.
  const ConjugatePairs& pairs() const { return pairs_; }
  /// The coefficients of the polynomials: of a (rows × size, at most two of them, stored as real
  /// numbers with pairs()) and of b (size × columns). An empty coefficient is zero.
  const std::vector<linalg::DenseMatrix>& a() const { return a_; }
  const std::vector<linalg::ComplexMatrix>& b() const { return b_; }
  /// The lengths of the columns of a and of the rows of b, [coefficient][index of ν].
  const std::vector<std::vector<double>>& aLengths() const { return aLengths_; }
  const std::vector<std::vector<double>>& bLengths() const { return bLengths_; }
  /// Return the row at which each part of P_CV ends, and the column at which each part of P_VC
  /// ends.
  std::span<const PetscInt> rowEnds() const { return rowEnds_; }
  std::span<const PetscInt> columnEnds() const { return columnEnds_; }

  /// Returns a bound of ‖Δ(z)‖ for |z| ≤ reach.
  double deviation(double reach) const { return eta0_ + (1 + reach) * eta1_; }
  /// Return bounds of the remainders of the majorants of P_CV and P_VC for |z| ≤ reach, including
  /// round-off.
  double errorTo(double reach) const { return error(errorTo_, reach); }
  double errorFrom(double reach) const { return error(errorFrom_, reach); }
  /// Return bounds of the norms of X as a map to V and of Y as a map from V.
  double normOfX() const { return normOfX_; }
  double normOfY() const { return normOfY_; }

 private:
  struct Pencil;
  struct Vectors;
  Vectors diagonalise(const Pencil& pencil);
  Vectors measure(const Pencil& pencil, const linalg::DenseMatrix& atTop,
                  const linalg::DenseMatrix& stored);
  void setCouplings(const KeptProblem& problem, const Vectors& vectors);
  double error(const std::array<double, 3>& byPower, double reach) const;

  double top_, reach_;
  bool squared_ = false, regular_ = false;
  std::vector<Complex> nu_;
  ConjugatePairs pairs_;
  std::vector<linalg::DenseMatrix> a_;
  std::vector<linalg::ComplexMatrix> b_;
  std::vector<std::vector<double>> aLengths_, bLengths_;
  std::vector<PetscInt> rowEnds_, columnEnds_;
  std::array<double, 3> errorTo_ = {}, errorFrom_ = {};  // [power of s / top]
  double eta0_ = 0, eta1_ = 0, normOfX_ = 0, normOfY_ = 0;
};

}  // namespace squeal::proof
