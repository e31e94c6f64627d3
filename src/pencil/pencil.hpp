#pragma once
/// The friction-perturbed problem P(s; f, v, …) d = 0 as one object, P = Σ_t c_t s^p_t A_t with c_t
/// = factor · f^a · v^b · c^d for the friction f, the speed v, a factor on the motion of the
/// bodies, and the factor c on their damping. It knows nothing of finite elements: [4.15–4.16]
/// enter as terms.
#include <array>
#include <complex>
#include <memory>
#include <vector>

#include "linalg/complexvector.hpp"
#include "petsc/owned.hpp"
#include "sweep/parameters.hpp"

namespace squeal::pencil {

struct Term {
  OwnedMat matrix;           ///< n×n
  int power = 0;             ///< of s: 0 stiffness, 1 damping, 2 mass
  int frictionExponent = 0;  ///< a
  double factor = 1;
  int speedExponent = 0;    ///< b
  int dampingExponent = 0;  ///< d

  double coefficient(const sweep::Parameters& at) const;
  /// Derivative of the coefficient with respect to one parameter.
  double slope(const sweep::Parameters& at, double sweep::Parameters::*parameter) const;
  /// The same term, its matrix shared.
  Term share() const;
};

class Pencil {
 public:
  explicit Pencil(std::vector<Term> terms);
  /// All terms, those of the point last.
  const std::vector<Term>& terms() const { return terms_; }
  /// Number of terms that hold for all parameters.
  std::size_t affineCount() const { return affineCount_; }
  /// Adds terms that hold for all parameters.
  void add(std::vector<Term> terms);
  /// Collective. These terms, whose matrices are shared, and some that hold at one point of the
  /// parameters alone, such as those made with its steady forces.
  Pencil with(std::vector<Term> pointTerms) const;
  bool hasPower(int power) const;
  MPI_Comm comm() const;

  /// Collective. Sum of the terms with this power of s, as a new matrix; empty if there are none.
  OwnedMat assembled(int power, const sweep::Parameters& at) const;
  /// Collective. y = (sum of the terms with this power) x.
  void apply(int power, const sweep::Parameters& at, Vec x, Vec y) const;
  /// Collective. y = (sum of the terms with this power)ᵀ x.
  void applyTranspose(int power, const sweep::Parameters& at, Vec x, Vec y) const;
  /// Collective. Estimate from below of the 2-norm of the sum, by power iteration on AᵀA continued
  /// from the last call for this power, be it at another point of the sweep: from below, so that a
  /// backward error made with it is never flattered.
  double norm(int power, const sweep::Parameters& at) const;

 private:
  std::vector<Term> terms_;
  std::size_t affineCount_;
  std::shared_ptr<std::array<OwnedVec, 3>>
      singular_;  // [power] where the next power iteration begins, shared by `with`
};

/// Which vectors of eigenpairs: right ones with P(s) d = 0, or left ones with P(s)ᴴ d = 0.
enum class Side { right, left };

/// Collective. P(s) d, or P(s)ᴴ d of the left side.
linalg::ComplexVector residual(const Pencil& pencil, const sweep::Parameters& at,
                               std::complex<double> s, const linalg::ComplexVector& d, Side side);

/// Collective. ‖P(s) d‖ / ((|s|² ‖M̄‖ + |s| ‖Z̄‖ + ‖K̄‖) ‖d‖).
double backwardError(const Pencil& pencil, const sweep::Parameters& at, std::complex<double> s,
                     const linalg::ComplexVector& d);

}  // namespace squeal::pencil
