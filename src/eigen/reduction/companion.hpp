// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The companion form of a dense quadratic problem, and its shift-and-invert operator. Not
/// collective.
#include <span>
#include <vector>

#include "algebra/linalg/complexdense.hpp"
#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/quadratic.hpp"

namespace squeal::reduction {

using linalg::ComplexMatrix;

/// Scales each column to the 2-norm 1.
void normalise(ComplexMatrix& x);
/// Returns the rows [first, last).
ComplexMatrix rowsOf(const ComplexMatrix& x, PetscInt first, PetscInt last);
/// Computes sum += factor X.
void addScaled(ComplexMatrix& sum, Complex factor, const ComplexMatrix& x);
/// Returns the largest |s| of a list; 1 for an empty list.
double largestSize(const std::vector<linalg::DensePair>& pairs);

/// Linearises a quadratic problem to one of twice the size
///   A z = s B z,   A = [0 I; −K −Z],   B = [I 0; 0 M],   z = (u, v) = (x, s x).
/// A vector z is stored as (u, v / unit), where `unit`, 1/s, gives both halves similar magnitudes.
/// A left vector y becomes the functional yᴴ[(sM + Z)u + M v] of z, which is zero for the right
/// vectors of all other eigenvalues.
class Companion {
 public:
  /// Borrows the problem.
  Companion(const linalg::DenseProblem& problem, double unit) : problem_(&problem), unit_(unit) {}
  const linalg::DenseProblem& problem() const { return *problem_; }
  PetscInt order() const { return problem_->order(); }
  double unit() const { return unit_; }
  /// Returns the right vectors of the pairs, 2m × pairs.
  ComplexMatrix right(const std::vector<const linalg::DensePair*>& pairs) const;
  /// Returns the functionals of the left vectors, up to factors, as columns l of 2-norm 1. The
  /// value at a stored z is lᴴ z.
  ComplexMatrix left(const std::vector<const linalg::DensePair*>& pairs) const;

 private:
  const linalg::DenseProblem* problem_;
  double unit_;
};

/// The operator (A − σB)⁻¹B of a companion form.
class ShiftInvert {
 public:
  /// Borrows the companion form and factorises P(σ).
  ShiftInvert(const Companion& companion, Complex shift);
  bool regular() const { return factors_.pivotRatio() > 0; }
  /// Returns the operator times the columns z.
  ComplexMatrix apply(const ComplexMatrix& z) const;
  /// Returns t = −P(σ)⁻ᴴ (l₁ + σ̄ l₂ / unit), where l₁ and l₂ are the halves of l. If the
  /// functional l is an eigenvector of the adjoint operator, t is a left vector of P.
  ComplexMatrix leftVectors(const ComplexMatrix& l) const;
  /// Returns the adjoint of the operator times the columns l.
  ComplexMatrix applyAdjoint(const ComplexMatrix& l) const;

 private:
  const Companion& companion_;
  Complex shift_;
  linalg::Lu<Complex> factors_;
};

}  // namespace squeal::reduction
