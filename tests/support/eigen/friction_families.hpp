// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small dense problems that depend on the friction, whose eigenvalues are known or cheap.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/tracking/family.hpp"
#include "eigen/tracking/track.hpp"
#include "support/algebra/dense.hpp"

namespace squeal::test {

/// The stiffness is K0 + f K1; M and Z do not depend on f.
struct Linear : tracking::Family {
  linalg::DenseProblem base;
  linalg::DenseMatrix friction;
  bool affine = true;
  Linear(linalg::DenseProblem problem, linalg::DenseMatrix slope)
      : base(std::move(problem)), friction(std::move(slope)) {}
  MPI_Comm comm() const override { return PETSC_COMM_WORLD; }
  bool isAffine() const override { return affine; }
  std::optional<linalg::DenseProblem> at(double f) override {
    linalg::DenseProblem problem = base;
    linalg::addScaled(problem.stiffness, f, friction);
    return problem;
  }
};

/// Friction couples two modes by the entry (i, j) and its negative at (j, i).
struct Coupling {
  PetscInt i, j;
  double size;
};

/// Returns a family with the eigenvalues ω² of its modes, `squares`, at friction zero.
inline Linear modal(const std::vector<double>& squares, const std::vector<Coupling>& couplings,
                    const std::vector<double>& damping = {}) {
  const PetscInt m = std::ssize(squares);
  linalg::DenseMatrix slope(m, m);
  for (const auto& [i, j, size] : couplings) {
    slope(i, j) += size;
    slope(j, i) += i == j ? 0 : -size;
  }
  return {{identity(m), diagonal(damping), diagonal(squares)}, slope};
}

/// Friction changes the eigenvalues of the modes, ω² = square + f · rate, so that they cross and
/// merge where wanted.
inline Linear crossingModes(const std::vector<double>& squares, const std::vector<double>& rates,
                            const std::vector<Coupling>& couplings) {
  Linear family = modal(squares, couplings);
  linalg::addScaled(family.friction, 1, diagonal(rates));
  return family;
}

/// Returns m modes about 100 rad/s apart, all of which friction couples at random.
inline Linear randomFamily(PetscInt m, unsigned seed, bool damped) {
  std::mt19937 generator(seed);
  std::vector<double> squares, damping;
  for (PetscInt i = 0; i < m; ++i) {
    squares.push_back(std::pow(100 * (1 + i + 0.4 * uniform(generator)), 2));
    if (damped) damping.push_back(100 * (0.02 + 0.015 * uniform(generator)) * (1 + i));
  }
  Linear family = modal(squares, {}, damping);
  for (PetscInt j = 0; j < m; ++j)
    for (PetscInt i = 0; i < m; ++i)
      family.friction(i, j) = 3e4 * uniform(generator) * std::sqrt((1.0 + i) * (1.0 + j));
  return family;
}

/// Returns the frictions from 0 to `top` in equal steps.
inline std::vector<double> grid(double top, int steps) {
  std::vector<double> list;
  for (int k = 0; k <= steps; ++k) list.push_back(top * k / steps);
  return list;
}

inline void expectNoGaps(const tracking::Branches& branches) {
  for (const auto& gap : branches.gaps)
    if (!gap.identityOnly) ADD_FAILURE() << gap.from << " to " << gap.to << ": " << gap.reason;
}

}  // namespace squeal::test
