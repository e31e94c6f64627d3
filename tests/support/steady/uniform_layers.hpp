// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady sliding of layers, whose strain and pressure are uniform, against the closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "run/analysis/analysis.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/largest_error.hpp"
#include "support/run/case.hpp"

namespace squeal::test {

inline constexpr double depth = 0.01;  // by which the case files press

/// Collective. Largest difference from `exact(x, y, part)` -> {u, v} at any node, relative to the
/// largest exact component.
template <class Exact>
double displacementError(const analysis::Analysis& analysis, const steady::Solution& solution,
                         const Exact& exact) {
  const auto& mesh = *analysis.model.mesh;
  const PetscScalar* values = nullptr;
  double error = 0, scale = 0;
  check(VecGetArrayRead(solution.displacement, &values));
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
    const auto i = static_cast<std::size_t>(node);
    const auto wanted = exact(mesh.coordinates[i], mesh.partName[mesh.nodePart[i]]);
    for (std::size_t d = 0; d < static_cast<std::size_t>(mesh.dimension); ++d) {
      error = worse(error,
                    std::abs(values[mesh.dimension * node + static_cast<PetscInt>(d)] - wanted[d]));
      scale = worse(scale, std::abs(wanted[d]));
    }
  }
  check(VecRestoreArrayRead(solution.displacement, &values));
  return largest(error) / largest(scale);
}

/// Collective. Pressure everywhere, its resultants over the contact, and friction along x ·
/// `sense`.
inline void expectUniformPressure(const analysis::Analysis& analysis,
                                  const steady::Solution& solution, double pressure, double area,
                                  double normalY, double sense) {
  double error = 0;
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& state = solution.contact[i];
    const double friction = sense * solution.at.friction * state.normalForce;
    error = worse(error, std::abs(state.pressure / pressure - 1));
    EXPECT_NEAR(state.gap, 0, 1e-10 * depth);
    EXPECT_NEAR(state.frictionForce[0], friction, 1e-12 * pressure * area);
    EXPECT_NEAR(state.frictionForce[1], 0, 1e-12 * pressure * area);
  }
  EXPECT_LT(largest(error), 1e-10);
  EXPECT_NEAR(solution.smallestPressure / pressure, 1, 1e-10);
  EXPECT_EQ(solution.openNodes, 0);
  EXPECT_LT(solution.imbalance, 1e-8);
  ASSERT_EQ(solution.resultants.size(), 1U);
  EXPECT_NEAR(solution.resultants[0].normalForce[1], normalY * pressure * area,
              1e-10 * pressure * area);
  EXPECT_NEAR(solution.resultants[0].frictionForce[0],
              sense * solution.at.friction * pressure * area, 1e-10 * pressure * area);
  EXPECT_GT(analysis.model.contact.interfaces.totalNodes, 0);
}

}  // namespace squeal::test
