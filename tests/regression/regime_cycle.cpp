// SPDX-License-Identifier: BSD-2-Clause
// Periodic motions of a coarse disc brake after flutter, and the branch that they form over the
// friction: it turns back below the onset of flutter and ends there.
#include <gtest/gtest.h>

#include <cmath>

#include "support/regime/regime_cases.hpp"

namespace squeal::test {
namespace {

const Options shortMarch = with(coarse, {{"flutter_friction", "0.3,0.34"},
                                         {"regime_friction", "0.34"},
                                         {"regime_start_factor", "1"},
                                         {"regime_time", "0.03"},
                                         {"regime_cycle", "on"},
                                         {"regime_cycle_steps", "128"}});

/// The branch, whose first motion is that of the march; two tests read it.
const ProgramRun& branchRun() {
  static const ProgramRun run = runProgram(
      "cycle_branch", 1, commandLine(with(shortMarch, {{"regime_cycle_range", "0.29,0.342"}})));
  return run;
}

// Motions of the smallest amplitude are linear except for the friction force, which turns with the
// velocity, so that the branch ends near the friction at which the mode is neutral.
TEST(RegimeCycle, BranchTurnsBackAndEndsAtTheOnset) {
  const ProgramRun& run = branchRun();
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto motions = readCsv(run.folder / "periodic.csv");
  const auto branch = readCsv(run.folder / "periodic_branch.csv");
  const auto friction = motions.column("motion_friction"), stable = motions.column("stable");
  ASSERT_GT(friction.size(), 3u);
  for (const double change : motions.column("change")) EXPECT_LE(change, 1e-6);
  // A contact that opens in a step is open for the whole of it: an error of the first order.
  for (const double trivial : motions.column("trivial_multiplier")) EXPECT_NEAR(trivial, 1, 0.01);
  // Towards smaller friction: one fold, and then back to where motions become linear.
  ASSERT_EQ(branch.words("towards"), (std::vector<std::string>{"smaller", "larger"}));
  const double fold = std::stod(branch.words("fold_friction").at(0)),
               end = branch.column("end_friction").at(0);
  EXPECT_LE(fold, *std::ranges::min_element(friction) + 1e-4);
  EXPECT_LT(fold, end - 1e-3);
  // The motion of the smallest amplitude, between fold and end, is unstable, that of the largest
  // has lost its stability by a pair; one between them is stable.
  const auto energy = motions.column("largest_kinetic_energy_j");
  EXPECT_EQ(stable[std::ranges::min_element(energy) - energy.begin()], 0);
  EXPECT_EQ(stable[std::ranges::max_element(energy) - energy.begin()], 0);
  EXPECT_GT(std::ranges::count(stable, 1), 0);
  const auto floquet = readCsv(run.folder / "floquet.csv");
  const double first = floquet.column("frequency_hz").at(0);  // of the largest multiplier
  EXPECT_GT(std::abs(first), 200);
  EXPECT_LT(std::abs(first), 600);
  // The mode is neutral where its growth rate, known at two frictions, is zero. With 128 steps a
  // march grows by some 3 1/s too much, of 2300 1/s per unit of friction: 1.5e-3.
  const auto table = readCsv(run.folder / "eigenvalues.csv");
  const auto growth = table.column("growth_rate_1_per_s"), at = table.column("friction");
  double low = 0, high = 0;
  for (std::size_t i = 0; i < growth.size(); ++i) {
    double& largest = at[i] < 0.32 ? low : high;
    largest = std::max(largest, growth[i]);
  }
  ASSERT_GT(low, 0);
  EXPECT_NEAR(end, 0.3 - 0.04 * low / (high - low), 4e-3);
}

// The columns of derivatives are spread over the ranks. On one rank the motion is the first of its
// branch.
TEST(RegimeCycle, IsTheSameOnTwoRanks) {
  const ProgramRun single = runProgram("cycle_ranks", 2, commandLine(shortMarch));
  std::vector<double> frequency, largest;
  for (const ProgramRun* run : {&branchRun(), &single}) {
    ASSERT_EQ(run->exitCode, 0) << run->error;
    const auto motions = readCsv(run->folder / "periodic.csv");
    if (run == &single) {
      ASSERT_EQ(motions.rows.size(), 1u);
    }
    ASSERT_EQ(motions.column("motion_friction").at(0), 0.34);
    frequency.push_back(motions.column("frequency_hz")[0]);
    largest.push_back(motions.column("largest_multiplier")[0]);
  }
  // Rounding makes marches differ, and with them where on the motion a period begins: a part of a
  // step, that of the rule's error.
  EXPECT_NEAR(frequency[1] / frequency[0], 1, 1e-5);
  EXPECT_NEAR(largest[1] / largest[0], 1, 0.02);
}

TEST(RegimeCycle, RefusesByName) {
  const auto refused = [](const Options& changes, const std::string& why) {
    const ProgramRun run = runProgram("cycle_refused", 1, commandLine(with(shortMarch, changes)));
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_NE(run.error.find(why), std::string::npos) << run.error;
  };
  refused({{"regime_cycle", "off"}}, "option -regime_cycle_steps");
  refused({{"regime_boundary", "mass"}}, "only with -regime_boundary massless");
  refused({{"regime_cycle_range", "0.4,0.3"}}, "option -regime_cycle_range: two frictions");
  refused({{"regime_cycle_motions", "3"}}, "no branch is followed");
}

}  // namespace
}  // namespace squeal::test
