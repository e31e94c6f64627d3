// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A dense problem like one in a basis that is orthonormal in energy, and its parts in smaller
/// bases.
#include <cmath>
#include <random>

#include "algebra/linalg/quadratic.hpp"
#include "support/algebra/dense.hpp"

namespace squeal::test {

enum class Damping { none, random };

/// Returns the problem of modes with the frequencies 1, 2, …: K = I and M = diag(1/ω²), with
/// friction in K, and in Z if damped, that couples all.
inline linalg::DenseProblem modalBrake(PetscInt order, double friction, Damping damping) {
  std::mt19937 generator(5);
  linalg::DenseProblem problem{
      linalg::DenseMatrix(order, order),
      damping == Damping::none ? linalg::DenseMatrix() : randomMatrix(order, order, generator),
      randomMatrix(order, order, generator)};
  for (PetscInt j = 0; j < order; ++j)
    for (PetscInt i = 0; i < order; ++i) {
      problem.stiffness(i, j) = (i == j ? 1 : 0) + friction * problem.stiffness(i, j);
      problem.mass(i, j) = i == j ? 1 / std::pow(i + 1.0, 2) : 0;
    }
  for (double& entry : problem.damping.entries()) entry *= friction / 30;
  return problem;
}

/// Returns the problem of the first unknowns.
inline linalg::DenseProblem leading(const linalg::DenseProblem& problem, PetscInt size) {
  const auto part = [&](const linalg::DenseMatrix& a) {
    return a.empty() ? linalg::DenseMatrix() : linalg::rowRange(a.columnRange(0, size), 0, size);
  };
  return {part(problem.mass), part(problem.damping), part(problem.stiffness)};
}

}  // namespace squeal::test
