// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The friction-perturbed eigenproblem whose P is a sum of terms [M.23],
///   P(s; f, v, c) d = 0,   P = Σ_t α_t f^a_t v^b_t c^e_t s^k_t A_t,
/// with the friction f, the factor v on the base velocities of the bodies, and the factor c on
/// their damping. The pencil does not depend on finite elements: the matrices of [4.15–4.16] enter
/// as terms. Numbers in brackets refer to equations in docs/method.md.
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "algebra/linalg/complexvector.hpp"
#include "base/petsc/owned.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::pencil {

/// One term of P.
struct Term {
  OwnedMat matrix;           ///< A, n×n
  int power = 0;             ///< k, power of s: 0 stiffness, 1 damping, 2 mass
  int frictionExponent = 0;  ///< a
  double factor = 1;         ///< α
  int speedExponent = 0;     ///< b
  int dampingExponent = 0;   ///< e
  /// True for a term that depends on friction although its friction exponent is 0. If the exponent
  /// is not 0, this flag makes no difference. A term that contains friction is not part of K0 or
  /// M0. After the free modes, the basis gets static responses to the forces of such terms.
  bool ofFriction = false;

  bool containsFriction() const { return ofFriction || frictionExponent != 0; }
  /// Returns true for a term of K0 or M0 [4.17]: one without friction, base motion or damping.
  bool isAssociated() const {
    return power != 1 && !containsFriction() && speedExponent == 0 && dampingExponent == 0;
  }
  double coefficient(const sweep::Parameters& at) const;
  /// Returns the derivative of the coefficient with respect to one parameter.
  double slope(const sweep::Parameters& at, double sweep::Parameters::*parameter) const;
  /// Returns a copy of this term that shares its matrix.
  Term share() const;
};

/// The sum of terms P.
class Pencil {
 public:
  /// Collective. Takes the terms, which hold for all parameters, and omits terms with power 1 whose
  /// matrix is zero.
  explicit Pencil(std::vector<Term> terms);
  /// Returns all terms; those that hold only at one point come last.
  const std::vector<Term>& terms() const { return terms_; }
  /// Returns the number of terms that hold for all parameters.
  std::size_t affineCount() const { return affineCount_; }
  /// Collective. Takes further terms that hold for all parameters. The pencil must not have terms
  /// that hold only at one point.
  void add(std::vector<Term> terms);
  /// Returns a pencil with the terms of this one, whose matrices it shares, and with `pointTerms`,
  /// which hold only at one point of the sweep. Collective unless `pointTerms` is empty.
  Pencil with(std::vector<Term> pointTerms) const;
  /// Returns a pencil with the terms of K0 and M0 that hold for all parameters, whose matrices it
  /// shares.
  Pencil associated() const;
  /// Collective. Returns sums of the terms that hold only at the point with these parameters: one
  /// sum, weighted by the coefficients, for each power of s and each value of isAssociated(). A
  /// term that is the only one of its kind is returned as it is and shares its matrix.
  std::vector<Term> pointSums(const sweep::Parameters& at) const;
  /// Returns true if there are terms with this power of s.
  bool hasPower(int power) const;
  MPI_Comm comm() const;

  /// Collective. Returns the sum of the terms with this power of s as a new matrix, n×n; null if
  /// there are none.
  OwnedMat assembled(int power, const sweep::Parameters& at) const;
  /// Collective. Sets y = (sum of the terms with this power) x.
  void apply(int power, const sweep::Parameters& at, Vec x, Vec y) const;
  /// Collective. Sets y = (sum of the terms with this power)ᵀ x.
  void applyTranspose(int power, const sweep::Parameters& at, Vec x, Vec y) const;
  /// Collective. Returns an estimate of the 2-norm of the sum of the terms with this power of s; 0
  /// if there are none. The estimate is a lower bound, so a backward error computed with it is
  /// never too small. The power iteration on AᵀA starts from the result of the last call for this
  /// power, even at another point of the sweep.
  double norm(int power, const sweep::Parameters& at) const;

 private:
  Pencil part(const std::function<bool(std::size_t)>& included) const;

  std::vector<Term> terms_;
  std::size_t affineCount_;
  std::shared_ptr<std::array<OwnedVec, 3>>
      singular_;  // for each power of s, the start vector of the next iteration in norm(); shared
                  // with the pencils that with() and associated() return
};

/// The side of an eigenvector: right with P(s) d = 0, or left with P(s)ᴴ d = 0.
enum class Side { right, left };

/// Collective. Returns P(s) d, or P(s)ᴴ d for the left side.
linalg::ComplexVector residual(const Pencil& pencil, const sweep::Parameters& at, Complex s,
                               const linalg::ComplexVector& d, Side side);

/// Collective. Returns the backward error of a right eigenpair [M.33],
///   ‖P(s) d‖ / ((|s|² ‖M̄‖ + |s| ‖Z̄‖ + ‖K̄‖) ‖d‖),
/// where M̄, Z̄ and K̄ are the sums of the terms with powers 2, 1 and 0, with the norms of norm().
double backwardError(const Pencil& pencil, const sweep::Parameters& at, Complex s,
                     const linalg::ComplexVector& d);

}  // namespace squeal::pencil
