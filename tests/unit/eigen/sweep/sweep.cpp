// SPDX-License-Identifier: BSD-2-Clause
// The grid of a sweep, its order and what each parameter scales.
#include <gtest/gtest.h>

#include <algorithm>

#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep/sweep.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using test::setOptions;

TEST(Sweep, IsTheGridOfAllParameters) {
  setOptions(
      "-flutter_friction 0.4,0.2,0.6 -flutter_speed 3,1 -flutter_pressure 1,2 -flutter_damping "
      "0:1:0.5");
  const auto sweep = sweep::grid(sweep::Settings::given());
  const auto steady = sweep.steadyPoints(), all = sweep.points();
  ASSERT_EQ(steady.size(), 12U);
  ASSERT_EQ(all.size(), 36U);
  EXPECT_EQ(steady[0], (sweep::Parameters{0.2, 1, 1, 1}));
  EXPECT_EQ(steady[2], (sweep::Parameters{0.6, 1, 1, 1}));
  EXPECT_EQ(steady[3], (sweep::Parameters{0.2, 1, 2, 1}));
  EXPECT_EQ(steady[11], (sweep::Parameters{0.6, 3, 2, 1}));
  for (std::size_t i = 0; i < all.size(); ++i) {
    sweep::Parameters wanted = steady[i % 12];
    wanted.damping = 0.5 * static_cast<double>(i / 12);
    EXPECT_EQ(all[i], wanted) << i;
  }
}

TEST(Sweep, WithoutOptionsIsOnePoint) {
  setOptions("");
  EXPECT_EQ(sweep::grid(sweep::Settings::given()).points(),
            std::vector<sweep::Parameters>{(sweep::Parameters{0.4, 1, 1, 1})});
}

/// Number of parameters in which two points differ.
int differences(const sweep::Parameters& a, const sweep::Parameters& b) {
  int count = 0;
  for (const auto& parameter : sweep::allParameters)
    count += a.*parameter.value != b.*parameter.value;
  return count;
}

TEST(Sweep, EverySteadyStateStartsFromANeighbour) {
  for (const std::string pressures : {"1", "1,2,3"}) {
    setOptions("-flutter_friction 0.2,0.4 -flutter_speed 1,2 -flutter_pressure " + pressures);
    const auto sweep = sweep::grid(sweep::Settings::given());
    const auto points = sweep.steadyPoints();
    EXPECT_FALSE(sweep.earlierNeighbour(0));
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto neighbour = sweep.earlierNeighbour(i);
      ASSERT_TRUE(neighbour) << i;
      EXPECT_LT(*neighbour, i);
      EXPECT_EQ(differences(points[*neighbour], points[i]), 1) << i;
    }
  }
}

TEST(Sweep, BatchesBeginWithEndsMiddleAndQuartersOfTheRange) {
  std::vector<sweep::Parameters> points;
  for (int i = 0; i <= 32; ++i) points.push_back({i / 32.0, 1, 1, 1});
  const auto batches = sweep::batches(points);
  std::vector<std::size_t> sizes, order;
  for (const auto& batch : batches) {
    sizes.push_back(batch.size());
    order.insert(order.end(), batch.begin(), batch.end());
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{5, 16, 12}));
  EXPECT_EQ(batches.front(),
            (std::vector<std::size_t>{32, 0, 16, 8,
                                      24}));  // largest friction, then farthest from those before
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(order.at(i), i);

  EXPECT_EQ(sweep::batches({sweep::Parameters{0.4, 1, 1, 1}}),
            (std::vector<std::vector<std::size_t>>{{0}}));
  EXPECT_TRUE(sweep::batches({}).empty());
}

TEST(Sweep, NamesAndTables) {
  EXPECT_EQ(sweep::parameterColumns(), "friction,speed,pressure,damping");
  EXPECT_EQ(sweep::parameterValues({0.3, 2, 0.5, 0}), "0.3,2,0.5,0");
  EXPECT_EQ(sweep::parameterText({0.3, 1, 1, 1}), "friction 0.3");
  EXPECT_EQ(sweep::parameterText({0.3, 2, 1, 0}), "friction 0.3, speed 2, damping 0");
}

TEST(Sweep, CoefficientsOfTerms) {
  pencil::Term term;
  term.factor = 7, term.frictionExponent = 1, term.speedExponent = 2, term.dampingExponent = 1;
  EXPECT_DOUBLE_EQ(term.coefficient({0.5, 3, 11, 4}), 7 * 0.5 * 9 * 4);
  EXPECT_EQ(term.coefficient({0.5, 3, 11, 0}), 0);
  EXPECT_DOUBLE_EQ(pencil::Term{}.coefficient({0, 3, 11, 0}), 1);  // 0⁰ = 1
}

/// ‖a x − b‖ / ‖b‖.
double distance(double a, Vec x, Vec b) {
  OwnedVec difference;
  PetscReal size = 0, whole = 0;
  check(VecDuplicate(b, difference.out()));
  check(VecWAXPY(difference, -1 / a, b, x));
  check(VecNorm(difference, NORM_2, &size));
  check(VecNorm(b, NORM_2, &whole));
  return a * size / whole;
}

// Loads and held displacements alike: K u = b with u = T x + u0 is linear, and complementarity is
// homogeneous.
TEST(Sweep, SteadySlidingIsProportionalToThePressure) {
  const auto analysis = test::runCase(
      "layer", "-mesh_set nx=8,ny=4 -modes_count 10 -flutter_friction 0.3 -flutter_pressure 1,3");
  ASSERT_EQ(analysis.steady.solutions.size(), 2U);
  ASSERT_EQ(analysis.steady.solutions[1].at.pressure, 3);
  // The tolerance of GMRES, 1e-13, with the condition of this small stiffness, some hundreds.
  EXPECT_LT(distance(3, analysis.steady.solutions[0].displacement,
                     analysis.steady.solutions[1].displacement),
            1e-11);
}

// 1000 frictions at 1000 speeds: each list is within its limit.
TEST(Sweep, OfTooManyPointsIsRefused) {
  test::setOptions("-flutter_friction 0:0.999:0.001 -flutter_speed 1:1000:1");
  const auto message = test::errorOf([] { sweep::grid(sweep::Settings::given()); });
  EXPECT_TRUE(
      test::contains(message, "1000 x 1000 x 1 x 1 = 1000000 points; a sweep has at most 100000"))
      << message;
  test::setOptions("-flutter_friction 0:0.099:0.001 -flutter_speed 1:1000:1");
  EXPECT_EQ(sweep::grid(sweep::Settings::given()).pointCount(), 100000);
}

}  // namespace
}  // namespace squeal
