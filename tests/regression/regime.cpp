// SPDX-License-Identifier: BSD-2-Clause
// What becomes of the unstable mode of a coarse disc brake: the reduced model has the certified
// eigenvalue, and the march its growth; bad input is refused by name.
#include <gtest/gtest.h>

#include <cmath>

#include "support/regime/regime_cases.hpp"

namespace squeal::test {
namespace {

// The start is a thousandth of the onset, so that all is linear. The rule is of first order: half
// the step gives half the error within 10 %, which covers round-off and the other modes that the
// start excites.
TEST(Regime, GrowsAsCertified) {
  std::vector<double> errors;
  for (const std::string step : {"1e-6", "5e-7"}) {
    const auto table = regimeOf(
        "growth", 1,
        {{"regime_step", step}, {"regime_time", "0.008"}, {"regime_start_factor", "0.001"}});
    EXPECT_EQ(table.words("class").at(0), "growing");
    // Galerkin's method with the eigenvector in its basis: only the errors of the free modes and
    // of the certified pair are left.
    EXPECT_LE(valueOf(table, "model_error"), 1e-8);
    errors.push_back(valueOf(table, "growth_rate_1_per_s") -
                     valueOf(table, "certified_growth_rate_1_per_s"));
  }
  EXPECT_LT(std::abs(errors[1]), 0.02 * 215.9);
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.2);
}

// The same under a coefficient that falls with the speed: the growth is higher, and the coefficient
// follows a step late, which is of first order too.
TEST(Regime, GrowsAsCertifiedUnderALawOfFriction) {
  std::vector<double> errors;
  for (const std::string step : {"1e-6", "5e-7"}) {
    const auto table = regimeOf("law", 1,
                                {{"friction_law", "exponential"},
                                 {"friction_static_ratio", "1.04"},
                                 {"friction_decay_speed", "0.5"},
                                 {"regime_step", step},
                                 {"regime_time", "0.008"},
                                 {"regime_start_factor", "0.001"}});
    EXPECT_EQ(table.words("class").at(0), "growing");
    EXPECT_LE(valueOf(table, "model_error"), 1e-8);
    EXPECT_NEAR(valueOf(table, "certified_growth_rate_1_per_s"), 228.96, 0.1);
    errors.push_back(valueOf(table, "growth_rate_1_per_s") -
                     valueOf(table, "certified_growth_rate_1_per_s"));
  }
  EXPECT_LT(std::abs(errors[1]), 0.02 * 228.96);
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.2);
}

// All nodes are there, and each spends its time somewhere.
TEST(Regime, TellsWhatEachNodeDoes) {
  const ProgramRun run =
      runProgram("regime_nodes", 1, commandLine(with(coarse, {{"regime_time", "0.008"}})));
  const auto nodes = readCsv(run.folder / "regime_nodes.csv");
  ASSERT_EQ(nodes.rows.size(), 45u);
  const auto open = nodes.column("open"), stick = nodes.column("stick"),
             slip = nodes.column("slip");
  for (std::size_t i = 0; i < open.size(); ++i) EXPECT_NEAR(open[i] + stick[i] + slip[i], 1, 2e-6);
  const auto onset = readCsv(run.folder / "onset.csv");
  ASSERT_EQ(onset.rows.size(), 1u);
  EXPECT_EQ(onset.words("event").at(0), "opens");
  // The onset of the full problem is that of the reduced one.
  EXPECT_NEAR(onset.column("kinetic_energy_j").at(0) /
                  readCsv(run.folder / "regime.csv").column("onset_kinetic_energy_j").at(0),
              1, 1e-5);
}

TEST(Regime, SaysThatNothingIsUnstable) {
  const ProgramRun run = runProgram(
      "regime_stable", 1,
      commandLine(with(coarse, {{"flutter_friction", "0.1"}, {"regime_friction", "0.1"}})));
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_NE(run.out.find("friction 0.1: no mode is unstable"), std::string::npos);
}

TEST(Regime, NamesTheStableStep) {
  const ProgramRun run =
      runProgram("regime_step", 1,
                 commandLine(with(coarse, {{"regime_step", "1e-4"}, {"regime_time", "0.02"}})));
  EXPECT_NE(run.exitCode, 0);
  EXPECT_NE(run.error.find("-regime_step 0.0001 s exceeds"), std::string::npos) << run.error;
}

// The law is judged at a step and a steady state: what is found before it stays.
TEST(Regime, RefusesALawOfFrictionAtItsPoint) {
  const ProgramRun run = runProgram("regime_steep_law", 1,
                                    commandLine(with(coarse, {{"friction_law", "exponential"},
                                                              {"friction_static_ratio", "1.3"},
                                                              {"friction_decay_speed", "0.5"},
                                                              {"regime_step", "1e-6"}})));
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_NE(run.error.find("friction 0.4: not followed after flutter"), std::string::npos);
  EXPECT_NE(run.error.find("give -regime_boundary mass"), std::string::npos) << run.error;
  EXPECT_TRUE(fs::exists(run.folder / "eigenvalues.csv"));
}

TEST(Regime, RefusesByName) {
  const auto refused = [](const std::string& options, const std::string& why) {
    const ProgramRun run = runProgram("regime_refused", 1, options);
    EXPECT_EQ(run.exitCode, 1) << options;
    EXPECT_NE(run.error.find(why), std::string::npos) << run.error;
  };
  refused(commandLine(with(coarse, {{"flutter_friction_damping", "off"}})),
          "-flutter_friction_damping must be on");
  refused(commandLine(with(coarse, {{"flutter_method", "direct"}})), "-flutter_method reduced");
  refused(commandLine(with(coarse, {{"flutter_modal_damping", "0.01"}})), "-flutter_modal_damping");
  refused(commandLine(with(coarse, {{"motion_convective", "on"}})), "convective terms");
  refused(commandLine(with(coarse, {{"friction_law", "exponential"}, {"regime_cycle", "on"}})),
          "remove -regime_cycle");
  refused("-options_file options/external.yaml -regime_friction 0.9", "matrices from files");
  refused("-options_file options/external.yaml -regime_time 1", "without -regime_friction");
}

}  // namespace
}  // namespace squeal::test
