// SPDX-License-Identifier: BSD-2-Clause
// The critical frictions of the disc brake at its full size, confirmed by direct solves on all
// unknowns just below and above. Minutes, so not part of the usual run.
#include "support/harness/same_on_ranks.hpp"

namespace squeal::test {
namespace {

const std::string common = "-options_file options/disc_brake.yaml -report_fields off ";

/// Number of eigenvalues within 1 % of a frequency that grow faster than `least`.
int growingNear(const ProgramRun& run, double frequency, double least) {
  const CsvTable table = readCsv(run.folder / "eigenvalues.csv");
  const auto growth = table.column("growth_rate_1_per_s"), hertz = table.column("frequency_hz");
  int count = 0;
  for (std::size_t i = 0; i < growth.size(); ++i)
    count += std::abs(hertz[i] - frequency) < 0.01 * frequency && growth[i] > least;
  return count;
}

// Growth rates leave zero as the square root of the distance from a coalescence, (Re s)² = slope ·
// Δf: a part of 1e-5 beyond it they must be nearly that, as far below it there must be none.
TEST(CriticalDiscBrake, IsConfirmedByDirectSolves) {
  const auto sweep =
      runProgram("critical_disc_brake/sweep", 2, common + "-flutter_friction 0:0.3:0.05", 900);
  ASSERT_EQ(sweep.exitCode, 0) << sweep.error;
  const CsvTable critical = readCsv(sweep.folder / "critical.csv");
  const auto friction = critical.column("friction"), frequency = critical.column("frequency_hz"),
             slope = critical.column("slope");
  ASSERT_GE(friction.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const double distance = 1e-5 * friction[i], growth = std::sqrt(slope[i] * distance);
    int counts[2] = {};
    for (const bool above : {false, true}) {
      const auto run =
          runProgram("critical_disc_brake/direct", 2,
                     common + "-flutter_method direct -flutter_direct_count 80 -flutter_friction " +
                         shortest(friction[i] + (above ? distance : -distance)),
                     900);
      ASSERT_EQ(run.exitCode, 0) << run.error;
      counts[above] = growingNear(run, frequency[i], 0.9 * growth);
    }
    std::printf(
        "critical friction %.9f at %.1f Hz: %d grow by more than 0.9 x %.3g just below, %d just "
        "above\n",
        friction[i], frequency[i], counts[0], growth, counts[1]);
    EXPECT_EQ(counts[1], counts[0] + 1);
  }
}

}  // namespace
}  // namespace squeal::test
