// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// How well eigenpairs solve a dense quadratic problem.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "support/algebra/dense.hpp"
#include "support/harness/largest_error.hpp"

namespace squeal::test {

inline std::vector<Complex> eigenvaluesOf(const std::vector<linalg::DensePair>& pairs) {
  std::vector<Complex> list;
  for (const auto& pair : pairs) list.push_back(pair.s);
  return list;
}

/// Returns ‖(s² M + s Z + K) q‖ over the size of s² M and K. Checks that q has the length 1.
inline double residual(const linalg::DenseProblem& problem, const linalg::DensePair& pair) {
  const PetscInt m = problem.order();
  const Complex s = pair.s;
  double rest = 0, scale = 0, length = 0;
  for (PetscInt i = 0; i < m; ++i) {
    Complex row = 0;
    for (PetscInt j = 0; j < m; ++j) {
      const Complex inertia = s * s * problem.mass(i, j),
                    friction = problem.damping.empty() ? 0 : s * problem.damping(i, j);
      row += (inertia + friction + problem.stiffness(i, j)) * pair.q.at(j);
      scale += std::norm(inertia) + std::norm(problem.stiffness(i, j));
    }
    rest += std::norm(row);
    length += std::norm(pair.q.at(i));
  }
  EXPECT_NEAR(length, 1, 1e-12);
  return std::sqrt(rest / scale);
}

inline double worstResidual(const linalg::DenseProblem& problem,
                            const std::vector<linalg::DensePair>& pairs) {
  double worst = 0;
  for (const auto& pair : pairs) worst = worse(worst, residual(problem, pair));
  return worst;
}

/// Returns the worst residual of the left vectors. The problem with each matrix transposed has
/// their conjugates as right vectors: yᴴ P(s) = 0 is P(s)ᵀ ȳ = 0.
inline double worstLeftResidual(const linalg::DenseProblem& problem,
                                const std::vector<linalg::DensePair>& pairs) {
  std::vector<linalg::DensePair> flipped;
  for (const auto& pair : pairs) {
    flipped.push_back({pair.s, pair.left});
    for (auto& entry : flipped.back().q) entry = std::conj(entry);
  }
  return worstResidual(
      {transposed(problem.mass), transposed(problem.damping), transposed(problem.stiffness)},
      flipped);
}

}  // namespace squeal::test
