// SPDX-License-Identifier: BSD-2-Clause
// The disc brake on its full mesh after flutter, against figures of another program: errors of the
// growth rate, and the periodic motion at friction 0.24.
#include <gtest/gtest.h>

#include <cmath>

#include "support/regime/regime_cases.hpp"

namespace squeal::test {
namespace {

const Options full = {{"options_file", "options/disc_brake_regime.yaml"},
                      {"flutter_friction", "0.4"},
                      {"report_fields", "off"}};

ProgramRun followed(const std::string& name, const Options& changes) {
  const ProgramRun run =
      runProgram("regime_full_" + name, 2, commandLine(with(full, changes)), 1200);
  EXPECT_EQ(run.exitCode, 0) << run.error;
  return run;
}

// Leapfrog and backward Euler: the growth of the march is too large by 2.05 1/s with steps of 1 µs
// and by 0.99 with 0.5 µs in the other program, which may treat damping otherwise: 20 %.
TEST(RegimeDiscBrake, GrowthErrorsAreThoseOfTheRule) {
  for (const auto& [step, expected] : {std::pair("1e-6", 2.05), std::pair("5e-7", 0.99)}) {
    const ProgramRun run = followed(
        "growth",
        {{"regime_step", step}, {"regime_time", "0.008"}, {"regime_start_factor", "0.001"}});
    const auto table = readCsv(run.folder / "regime.csv");
    EXPECT_LE(valueOf(table, "model_error"), 1e-8);
    EXPECT_NEAR(valueOf(table, "certified_growth_rate_1_per_s"), 271.828, 1e-2);
    EXPECT_NEAR(
        valueOf(table, "growth_rate_1_per_s") - valueOf(table, "certified_growth_rate_1_per_s"),
        expected, 0.2 * expected);
  }
}

// The other program has 7846.46 Hz with 256 steps a period and a pair of multipliers of 1.1005 at
// 449 Hz. The trivial multiplier shows the error of the step.
TEST(RegimeDiscBrake, HasAnUnstablePeriodicMotion) {
  const ProgramRun run = followed("cycle", {{"flutter_friction", "0.24"},
                                            {"regime_friction", "0.24"},
                                            {"regime_start_factor", "2"},
                                            {"regime_time", "0.04"},
                                            {"regime_cycle", "on"},
                                            {"regime_cycle_steps", "256"}});
  const auto motions = readCsv(run.folder / "periodic.csv");
  ASSERT_EQ(motions.rows.size(), 1u);
  EXPECT_NEAR(valueOf(motions, "frequency_hz"), 7846.46, 0.5);
  EXPECT_NEAR(valueOf(motions, "trivial_multiplier"), 1, 2e-3);
  EXPECT_NEAR(valueOf(motions, "largest_multiplier"), 1.1005, 0.03);
  EXPECT_NEAR(valueOf(motions, "friction_power_w"), 754, 5);
  EXPECT_NEAR(std::abs(valueOf(readCsv(run.folder / "floquet.csv"), "frequency_hz")), 449, 25);
}

}  // namespace
}  // namespace squeal::test
