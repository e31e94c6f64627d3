// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Null vectors of the full-order problem, P(s) x = 0 and yᴴ P(s) = 0, for known eigenvalues.
#include <vector>

#include "algebra/linalg/complexvector.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::sensitivity {

/// An eigenvalue and its right vector in the unknowns x.
struct RightPair {
  Complex s;
  const linalg::ComplexVector* vector;  ///< borrowed
};

/// A right or left vector z and its backward error.
struct NullVector {
  linalg::ComplexVector vector;  ///< in the unknowns, 2-norm 1
  /// The backward error (with P(s)ᴴ in place of P(s) for a left vector),
  ///   ‖P(s) z‖ / ((|s|² ‖M̄‖ + |s| ‖Z̄‖ + ‖K̄‖) ‖z‖).
  double backwardError = 0;
  int rounds = 0;  ///< number of rounds of the search
};

/// The start space of the search for null vectors.
struct StartSpace {
  /// This rank's rows of V: the free modes, or the basis of the reduced problem; borrowed.
  linalg::DenseView columns{nullptr, 0, 0};
  Mat inner = nullptr;  ///< the matrix in which V is nearly orthonormal, M0 or K0; borrowed
  linalg::DenseProblem projected;  ///< Vᵀ P V at the point, which saves products with V; empty
                                   ///< if unknown
};

/// Collective. Returns V c, scaled to the 2-norm 1, as a vector of the unknowns of the pencil.
/// `columns` contains this rank's rows of V.
linalg::ComplexVector expanded(const pencil::Pencil& pencil, const linalg::DenseView& columns,
                               const std::vector<Complex>& c);

/// The settings of the search for null vectors.
struct Search {
  double accuracy = 1e-10;  ///< largest acceptable backward error
  bool simple = true;  ///< true: s may be inexact and is corrected; false: eigenvalues may meet at
                       ///< s, which must be exact
};

/// Collective. Returns the left vectors of all pairs, [pair], by Rayleigh–Ritz on a basis that
/// starts with V and the right vectors. Each round extends it by
///   K0⁻¹ Re l, K0⁻¹ Im l,   l = P(s)ᴴ y,
/// for the left residuals l of all inaccurate pairs together, with `solver`, a borrowed
/// factorisation of K0. A round reduces the errors about tenfold. The rounds end when each backward
/// error is at most `search.accuracy`, or is below 1e-10 and no longer halves; when the basis no
/// longer grows; or after 20 rounds. The caller must check the remaining errors.
std::vector<NullVector> leftVectors(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                    const StartSpace& start, KSP solver,
                                    const std::vector<RightPair>& pairs, const Search& search);

/// Collective. Returns the right vector at an eigenvalue s in the same way, from V. Right and left
/// vectors are the singular vectors of the smallest singular value of P(s), so they are well
/// defined even where two eigenvalues and their vectors meet.
NullVector rightVector(const pencil::Pencil& pencil, const sweep::Parameters& at,
                       const StartSpace& start, KSP solver, Complex s, const Search& search);

}  // namespace squeal::sensitivity
