// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tests of the dense condensed matrix A of the contact. They decide on existence and uniqueness of
/// solutions of the linear complementarity problem
///   g = A R + F,   g ≥ 0,   R ≥ 0,   g·R = 0.
/// Not collective; matrices are the same on every rank.
#include <string>
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::uniqueness {

/// The result of the tests at one friction, valid for all loads.
struct Judgement {
  double friction = 0;
  double smallest = 0;  ///< smallest eigenvalue of sym(A(f)), m/N; NaN if unknown
  std::string verdict;  ///< "one solution", "a solution exists" or "not decided"
  std::string reason;   ///< the deciding test, or why no test decided
};

/// Returns the eigenvalues of sym(A), ascending. Throws Error if LAPACK fails.
std::vector<double> eigenvaluesOfSymmetricPart(const linalg::DenseMatrix& a);

/// Returns true if the smallest of these ascending eigenvalues is positive beyond round-off.
bool positiveDefinite(const std::vector<double>& eigenvalues);

/// Returns true if all principal minors are positive, which is equivalent to one solution for every
/// F. The recursion of Tsatsomeros and Li (BIT 40 (2000) 410–414) takes 2ⁿ pivots.
bool pMatrix(const linalg::DenseMatrix& a);

/// Returns true if sym(A) stays positive definite without its positive off-diagonal entries. This
/// is sufficient for strict copositivity, and therefore for a solution for every F.
bool surelyCopositive(const linalg::DenseMatrix& a);

/// Returns the verdict on A(f), m/N. If sym(A) is not positive definite, the P-matrix test is
/// applied up to n = `pMatrixLimit`.
Judgement examineMatrix(const linalg::DenseMatrix& a, double friction, int pMatrixLimit);

/// Returns the friction at which positive definiteness is lost [M.19],
///   f = −1/μ,
/// where μ = `smallestRatio` is the smallest eigenvalue of sym(A1) v = μ A0 v; infinite unless μ is
/// negative beyond round-off.
double lossOfPositivity(double smallestRatio);

/// Returns the smallest f > 0 at which sym(A0 + f A1) is not positive definite; infinite if there
/// is none, and 0 if A0 is not positive definite. Throws Error if LAPACK fails.
double lossOfPositivity(const linalg::DenseMatrix& a0, const linalg::DenseMatrix& a1);

}  // namespace squeal::uniqueness
