// SPDX-License-Identifier: BSD-2-Clause
// Steady sliding of a stiff brake, three steel parts: the linear solvers reach round-off, and only
// round-off is accepted. The pads are pressed on by a uniform pressure and held only by springs, so
// that statics gives the resultants of contact and springs.
#include <gtest/gtest.h>

#include <cmath>

#include "model/contact/coupled.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/model/steel_brake.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using test::steel_brake::padArea;
using test::steel_brake::pressure;

std::vector<steady::Solution> solutions(const std::string& options,
                                        const std::vector<double>& frictions) {
  test::setOptions(options);
  const test::Model model = test::buildModel();
  const contact::CoupledSystem system(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  std::vector<steady::Solution> all;
  for (double friction : frictions) all.push_back(problem.solve({friction}, system));
  return all;
}

void expectBalance(const steady::Solution& solution, double residual) {
  ASSERT_TRUE(solution.converged) << "friction " << solution.at.friction << ": " << solution.reason;
  test::print("friction %g: residual %.1e, imbalance %.1e, smallest pressure %.6g\n",
              solution.at.friction, solution.residual, solution.imbalance,
              solution.smallestPressure);
  EXPECT_LT(solution.residual, residual);
  EXPECT_LT(solution.imbalance, residual);    // of every part: contact, springs and load
  EXPECT_EQ(solution.resultants.size(), 2u);  // of both pads
  for (const auto& resultant : solution.resultants) {
    EXPECT_NEAR(std::abs(resultant.normalForce[2]) / (pressure * padArea), 1, 3e-3);
    // The friction forces, at right angles to the radius, point along nearly half the circle: their
    // resultant is f R_N times the ratio of chord to arc for a uniform pressure, which friction
    // changes by its moment about the contact.
    const double tangential = std::hypot(resultant.frictionForce[0], resultant.frictionForce[1]);
    EXPECT_LE(tangential, solution.at.friction * std::abs(resultant.normalForce[2]) * (1 + 1e-12));
    EXPECT_GE(tangential, 0.9 * solution.at.friction * std::abs(resultant.normalForce[2]));
  }
}

// GMRES on this problem stagnates at a relative residual between 1e-11 and 1e-13, at which of them
// depends on the number of ranks. Epsilon times the forces of which the residual is the difference,
// some 1e8 N/m x 1e-4 m on each node, is 1e-11 of the loads.
TEST(SteelBrake, ClosedContactIsFoundToRounding) {
  for (const auto& solution : solutions(test::steel_brake::options(2, 0.022, 1e7), {0, 0.1, 0.25}))
    expectBalance(solution, 1e-10);
}

// Springs of 1 kN/m let the pads move by 2 m, and rounding of forces that displacements of metres
// make is 1e-7 of the loads.
TEST(SteelBrake, WeaklyHeldPads) {
  const auto firm = solutions(test::steel_brake::options(2, 0.022, 1e5), {0.25}),
             weak = solutions(test::steel_brake::options(2, 0.022, 1e3), {0.25});
  expectBalance(firm[0], 1e-8);
  expectBalance(weak[0], 1e-6);
  // Both springs are soft compared with the pads: the pressure is the same except for the share of
  // the elastic deformation in their motion.
  EXPECT_NEAR(weak[0].smallestPressure / firm[0].smallestPressure, 1, 1e-2);
}

// Springs of 1 N/m are less than rounding of the stiffness of the pads: forces would be right to
// four digits. This is said.
TEST(SteelBrake, PadsHeldByNothingButRounding) {
  const auto solution = std::move(solutions(test::steel_brake::options(2, 0.022, 1), {0.25})[0]);
  EXPECT_FALSE(solution.converged);
  EXPECT_NE(solution.reason.find("round-off leaves"), std::string::npos) << solution.reason;
  EXPECT_GT(solution.residual, 1e-6);
}

// On linear faces SNES VI decides which nodes open. The motion of the pads as a whole, 4 m, must
// not hide gaps of nanometres.
TEST(SteelBrake, OpeningContactOfWeaklyHeldPads) {
  std::vector<PetscInt> open;
  for (const double spring : {1e7, 1e3}) {
    const auto solution =
        std::move(solutions(test::steel_brake::options(1, 0.012, spring), {0.5})[0]);
    ASSERT_TRUE(solution.converged) << solution.reason;
    expectBalance(solution, spring > 1e6 ? 1e-10 : 1e-6);
    double largest = 0;
    for (const auto& state : solution.contact) largest = test::worse(largest, state.normalForce);
    largest = test::largest(largest);
    for (std::size_t i = 0; i < solution.contact.size(); ++i) {
      const auto& [gap, coefficient, normal, area, friction] = solution.contact[i];
      EXPECT_GE(gap, 0);
      EXPECT_GT(normal, -1e-5 * largest);
      if (solution.closed[i])
        EXPECT_EQ(gap, 0);
      else
        EXPECT_LT(normal, 1e-5 * largest);
    }
    open.push_back(solution.openNodes);
  }
  EXPECT_GT(open[0], 0);
  EXPECT_EQ(open[0], open[1]);
}

}  // namespace
}  // namespace squeal
