#pragma once
/// Small dense tests of the condensed matrix A of the contact: what they say of the complementarity
/// problem g = A R + F, g ≥ 0, R ≥ 0, g·R = 0. Matrices are n×n, column-major, the same on every
/// rank; nothing here is collective.
#include <string>
#include <vector>

namespace squeal::steady {

/// What is known of the steady sliding states at one friction, whatever the loads.
struct Judgement {
  double friction = 0;
  double smallest = 0;  ///< smallest eigenvalue of sym(A(f)), m/N; NaN where unknown
  std::string verdict;  ///< "one solution", "a solution exists" or "not decided"
  std::string reason;
};

/// Eigenvalues of sym(A), ascending. Error if LAPACK fails.
std::vector<double> symmetricEigenvalues(const std::vector<double>& a, int n);

/// The smallest of them stands out from rounding and is positive.
bool positiveDefinite(const std::vector<double>& eigenvalues);

/// All principal minors are positive: one solution for every F, and only then. The recursion of
/// Tsatsomeros and Li (BIT 40 (2000) 410–414), 2ⁿ pivots.
bool pMatrix(const std::vector<double>& a, int n);

/// Sufficient for strict copositivity, hence for a solution: sym(A) stays positive definite without
/// its positive off-diagonal entries.
bool surelyCopositive(const std::vector<double>& a, int n);

/// Verdict on A(f), m/N. The P-matrix test is made up to n = `pMatrixLimit`, where sym(A) is not
/// positive definite.
Judgement judge(const std::vector<double>& a, int n, double friction, int pMatrixLimit);

/// f = −1/μ, the friction where positive definiteness is lost, from the smallest eigenvalue μ of
/// sym(A1) v = μ A0 v: infinite unless μ is negative beyond rounding.
double lossOfPositivity(double smallestRatio);

/// The smallest f > 0 where sym(A0 + f A1) is not positive definite; infinite if there is none, 0
/// if A0 is not.
double lossOfPositivity(const std::vector<double>& a0, const std::vector<double>& a1, int n);

}  // namespace squeal::steady
