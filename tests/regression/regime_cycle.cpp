// Periodic motions of a coarse disc brake after flutter, and the branch that they form over the
// friction: it turns back below the onset of flutter and ends there.
#include <gtest/gtest.h>

#include <cmath>

#include "support/regime_runs.hpp"

namespace squeal::test {
namespace {

const Options shortMarch = with(coarse, {{"flutter_friction", "0.3,0.34"},
                                         {"regime_friction", "0.34"},
                                         {"regime_start_factor", "1"},
                                         {"regime_time", "0.03"},
                                         {"regime_cycle", "on"},
                                         {"regime_cycle_steps", "128"}});

// The rule of the march is of first order, and so is the friction at which a mode neither grows nor
// decays by it.
TEST(RegimeCycle, BranchTurnsBackAndEndsAtTheOnset) {
  std::vector<double> errors;
  for (const std::string steps : {"128", "256"}) {
    const ProgramRun run = runProgram(
        "cycle_" + steps, 1,
        commandLine(with(shortMarch,
                         {{"regime_cycle_range", "0.29,0.342"}, {"regime_cycle_steps", steps}})));
    ASSERT_EQ(run.exitCode, 0) << run.error;
    const auto motions = readCsv(run.folder / "periodic.csv");
    const auto branch = readCsv(run.folder / "periodic_branch.csv");
    const auto friction = motions.column("motion_friction"), stable = motions.column("stable"),
               trivial = motions.column("trivial_multiplier"), change = motions.column("change");
    ASSERT_GT(friction.size(), 3u);
    for (std::size_t i = 0; i < friction.size(); ++i) {
      EXPECT_LE(change[i], 1e-6);
      // Contacts that open in a step are open for the whole of it.
      EXPECT_NEAR(trivial[i], 1, 0.01);
    }
    // Towards smaller friction: one fold, and then back to where motions become linear.
    ASSERT_EQ(branch.words("towards"), (std::vector<std::string>{"smaller", "larger"}));
    const double fold = branch.column("fold_friction").at(0),
                 end = branch.column("end_friction").at(0);
    EXPECT_LT(fold, end);
    EXPECT_LE(fold, *std::ranges::min_element(friction) + 1e-4);
    // The motions of smaller amplitude, between fold and end, are unstable by a real multiplier.
    const auto energy = motions.column("largest_kinetic_energy_j");
    const std::size_t smallest = std::ranges::min_element(energy) - energy.begin();
    EXPECT_EQ(stable[smallest], 0);
    // Where the mode is neutral, from its growth rates at two frictions.
    const auto table = readCsv(run.folder / "eigenvalues.csv");
    const auto growth = table.column("growth_rate_1_per_s"), at = table.column("friction");
    double low = 0, high = 0;
    for (std::size_t i = 0; i < growth.size(); ++i)
      (at[i] < 0.305 ? low : high) = std::max(at[i] < 0.305 ? low : high, growth[i]);
    ASSERT_GT(low, 0);
    errors.push_back(end - (0.3 - 0.04 * low / (high - low)));
  }
  EXPECT_LT(std::abs(errors[1]), 3e-3);
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.3);
}

// The columns of derivatives are spread over the ranks.
TEST(RegimeCycle, IsTheSameOnTwoRanks) {
  std::vector<double> frequency, largest;
  for (const int ranks : {1, 2}) {
    const ProgramRun run = runProgram("cycle_ranks", ranks, commandLine(shortMarch));
    ASSERT_EQ(run.exitCode, 0) << run.error;
    const auto motions = readCsv(run.folder / "periodic.csv");
    ASSERT_EQ(motions.rows.size(), 1u);
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
  refused({{"regime_boundary", "mass"}}, "-regime_boundary massless only");
  refused({{"regime_cycle_range", "0.4,0.3"}}, "option -regime_cycle_range: two frictions");
  refused({{"regime_cycle_motions", "3"}}, "no branch is followed");
}

}  // namespace
}  // namespace squeal::test
