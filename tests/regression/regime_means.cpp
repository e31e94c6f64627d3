// SPDX-License-Identifier: BSD-2-Clause
// The regime after flutter depends neither on ranks nor on the mass of the boundary.
#include <gtest/gtest.h>

#include "support/regime/regime_cases.hpp"

namespace squeal::test {
namespace {

// Single cycles differ, as the regime is sensitive; means agree. Contact and friction hold at every
// step to 1e-5 of the mean force.
TEST(Regime, IsTheSameOnAnyNumberOfRanksAndWithTheMassOfTheBoundary) {
  const auto one = regimeOf("one", 1, {{"regime_time", "0.025"}}),
             two = regimeOf("two", 2, {{"regime_time", "0.025"}}),
             mass = regimeOf("mass", 1, {{"regime_time", "0.025"}, {"regime_boundary", "mass"}});
  for (const auto* table : {&one, &two, &mass}) {
    EXPECT_NE(table->words("class").at(0), "growing");
    EXPECT_GT(valueOf(*table, "open_nodes"), 0);
    EXPECT_GT(valueOf(*table, "sticking_nodes"), 0);
    EXPECT_LE(valueOf(*table, "largest_defect"), 1e-5);
    // Part of the pad lifts off and sticks, so that it rubs less than in steady sliding.
    EXPECT_LT(valueOf(*table, "friction_coefficient"), 0.4);
    EXPECT_LT(valueOf(*table, "friction_power_w"), valueOf(*table, "steady_friction_power_w"));
  }
  const auto near = [](const CsvTable& a, const CsvTable& b, const std::string& column,
                       double tolerance) {
    EXPECT_NEAR(valueOf(a, column) / valueOf(b, column), 1, tolerance) << column;
  };
  near(one, two, "friction_power_w", 0.02);
  near(one, two, "friction_coefficient", 0.02);
  near(one, two, "carrier_hz", 0.01);
  near(one, mass, "friction_power_w", 0.05);
  near(one, mass, "friction_coefficient", 0.05);
}

}  // namespace
}  // namespace squeal::test
