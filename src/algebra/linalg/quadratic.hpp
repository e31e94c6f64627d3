// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small dense quadratic eigenproblems with real unsymmetric matrices, solved by LAPACK.
#include <functional>
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::linalg {

/// The quadratic eigenproblem
///   (s² M + s Z + K) q = 0
/// with real matrices of order m. An empty Z is treated as zero.
struct DenseProblem {
  DenseMatrix mass, damping, stiffness;
  PetscInt order() const { return stiffness.rows(); }  ///< m
  /// Returns the matrix with this power of s.
  DenseMatrix& ofPower(int power) { return power == 0 ? stiffness : power == 1 ? damping : mass; }
};

/// Returns true if, within round-off, M and K are symmetric positive definite and Z is
/// antisymmetric. Then the only velocity-dependent forces are gyroscopic and do no work, and all
/// eigenvalues are imaginary: for any vector q of length 1, the equation
///   s² m + i s g + k = 0,   m = qᴴ M q > 0,   k = qᴴ K q > 0,   i g = qᴴ Z q,
/// has only imaginary roots.
bool conservative(const DenseProblem& problem);

/// An eigenvalue with its vectors.
struct DensePair {
  Complex s;               ///< eigenvalue, in 1/s
  std::vector<Complex> q;  ///< right vector, [m], 2-norm 1
  /// Left vector y with yᴴ P(s) = 0, [m], 2-norm 1; empty unless requested.
  std::vector<Complex> left = {};
};

/// The eigenvectors that a solve returns: the right ones, or both the right and the left ones.
enum class Vectors { right, both };

/// Selects eigenvalues: returns true if a solve is to return s. An empty function selects all.
using EigenvalueFilter = std::function<bool(Complex)>;

/// Returns the root of s² = −μ with Im s ≥ 0.
Complex rootOf(Complex mu);

/// Not collective. Returns the finite eigenvalues with Im s ≥ 0 that `wanted` selects, in ascending
/// order of Im s, then of Re s. If Z is empty, an eigenvalue s = 0 is a double root for each of its
/// vectors, but is listed only once per vector.
///
/// If Z is empty, the problem is linear in s² and has the size m. Otherwise the companion form of
/// size 2m is scaled (Fan, Lin and Van Dooren 2004) and solved. The leading matrix is K if K is
/// well conditioned, otherwise M or K, whichever is better conditioned. If it is K, the problem is
/// solved for 1/s. A problem without Z is solved as a symmetric one if K and M are symmetric within
/// round-off and the leading matrix is positive definite. All other problems are solved by the QR
/// algorithm with the inverse of the leading matrix. If this matrix cannot be inverted safely, the
/// QZ algorithm is used, which takes ten times as long.
///
/// Throws Error if an entry is not finite, if LAPACK fails, or if M and K have a common null
/// vector.
std::vector<DensePair> solveQuadratic(const DenseProblem& problem, Vectors vectors = Vectors::right,
                                      const EigenvalueFilter& wanted = {});

/// Not collective. Returns A times the right vectors of the pairs, m × pairs. An empty A is treated
/// as zero.
ComplexMatrix timesVectors(const DenseView& a, const std::vector<DensePair>& pairs);
/// Not collective. Returns Aᵀ times the left vectors of the pairs, m × pairs. An empty A is treated
/// as zero.
ComplexMatrix transposedTimesLeft(const DenseView& a, const std::vector<DensePair>& pairs);

}  // namespace squeal::linalg
