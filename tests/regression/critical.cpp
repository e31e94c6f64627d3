// SPDX-License-Identifier: BSD-2-Clause
// The tables of followed eigenvalues and of critical frictions, as a run leaves them behind.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/harness/largest_error.hpp"
#include "support/harness/same_on_ranks.hpp"

namespace squeal::test {
namespace {

// Damping on either side of the contact parts the critical frictions of the layers, which without
// it are all zero.
const std::string layers =
    "-options_file options/two_layers.yaml -mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 60 "
    "-quiet -report_fields off"
    " -material_pad_rayleigh_stiffness 0.005 -material_disc_rayleigh_mass 0.005 ";

struct Law {
  std::string name, options;
};
/// A coefficient that falls with the speed gives each friction terms of its own.
const Law constant{"constant", ""}, falling{"falling",
                                            "-friction_law exponential -friction_static_ratio 1.05 "
                                            "-friction_decay_speed 1 -flutter_track "};

/// The same run on 1 to 3 ranks, which several tests read.
const ProgramRun& layersOn(int ranks, const Law& law = constant) {
  static std::map<std::string, std::map<int, ProgramRun>> runs;
  if (runs[law.name].empty())
    for (int count : {1, 2, 3})
      runs[law.name][count] = runProgram("critical/" + law.name + std::to_string(count), count,
                                         layers + law.options + "-flutter_friction 0:0.4:0.1");
  return runs[law.name].at(ranks);
}

// With damping at friction 0 and a basis smaller than the full space, the program states both
// reservations on completeness.
TEST(Critical, CompletenessOfAPartOfTheSpace) {
  ASSERT_EQ(layersOn(2).exitCode, 0);
  const auto summary = nlohmann::json::parse(contentOf(layersOn(2).folder / "summary.json"));
  const auto followed = summary.at("active_sets").at(0).at("followed").at(0);
  EXPECT_EQ(followed.at("complete"), true);
  EXPECT_EQ(followed.at("sturm_count_exact"), false);
  EXPECT_EQ(followed.at("whole_space"), false);
  const std::string statement = followed.at("statement");
  EXPECT_NE(statement.find("not confirmed by a Sturm count"), std::string::npos) << statement;
  EXPECT_NE(statement.find("; assumed: every eigenvalue of the full problem"), std::string::npos)
      << statement;
}

void expectSameOnAllRanks(const Law& law) {
  std::vector<double> one;
  for (int ranks : {1, 2, 3}) {
    ASSERT_EQ(layersOn(ranks, law).exitCode, 0) << layersOn(ranks, law).error;
    const CsvTable table = readCsv(layersOn(ranks, law).folder / "critical.csv");
    EXPECT_EQ(table.header,
              "active_set,branch,partner,kind,direction,friction,speed,pressure,damping,frequency_"
              "hz,slope,"
              "friction_error_estimate,backward_error,converged,free_mode,energy_share,"
              "second_free_mode,second_energy_share,name");
    const auto friction = table.column("friction"),
               estimate = table.column("friction_error_estimate"),
               error = table.column("backward_error"), converged = table.column("converged");
    ASSERT_GE(friction.size(), 8U);
    EXPECT_TRUE(std::is_sorted(friction.begin(), friction.end()));
    for (std::size_t i = 0; i < friction.size(); ++i) {
      EXPECT_EQ(table.rows[i][3], "hopf");
      EXPECT_EQ(table.rows[i][4], "loss");
      EXPECT_EQ(converged[i], 1);
      EXPECT_LT(estimate[i], 1e-9);
      EXPECT_LT(error[i], 1e-9);
    }
    if (ranks == 1) one = friction;
    ASSERT_EQ(friction.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(friction[i], one[i], 1e-9) << i;
  }
}

TEST(Critical, SameFrictionsOnAllRanks) { expectSameOnAllRanks(constant); }
TEST(Critical, SameFrictionsWhereTermsBelongToPoints) { expectSameOnAllRanks(falling); }

// At each critical friction the problem on all unknowns has an eigenvalue iω of the frequency
// listed. Growth rates err by the slope, 0.6 at most, times the tolerance of the friction, 1e-9.
void expectZeroGrowthOfAllUnknowns(const Law& law) {
  ASSERT_EQ(layersOn(2, law).exitCode, 0);
  const CsvTable table = readCsv(layersOn(2, law).folder / "critical.csv");
  const auto friction = table.column("friction"), hertz = table.column("frequency_hz");
  ASSERT_GE(friction.size(), 8U);
  std::string list;
  for (double f : friction) list += formatted("%s%.17g", list.empty() ? "" : ",", f);
  const ProgramRun run =
      runProgram("critical/direct", 1,
                 layers + law.options +
                     "-flutter_method direct -flutter_direct_count 40 -flutter_friction " + list);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const CsvTable full = readCsv(run.folder / "eigenvalues.csv");
  const auto at = full.column("friction");
  const auto all = eigenvaluesOf(full);
  double worst = 0;
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const Complex wanted(0, 2 * M_PI * hertz[i]);
    double nearest = INFINITY;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (at[k] == friction[i]) nearest = std::min(nearest, std::abs(all[k] - wanted));
    EXPECT_LT(nearest, 1e-9 * std::abs(wanted)) << "friction " << friction[i];
    worst = test::worse(worst, nearest / std::abs(wanted));
  }
  std::printf("%zu critical frictions: full-order eigenvalues off i omega by %.1e at most\n",
              friction.size(), worst);
}

TEST(Critical, GrowthRatesOfAllUnknownsAreZero) { expectZeroGrowthOfAllUnknowns(constant); }
TEST(Critical, GrowthRatesAreZeroWhereTermsBelongToPoints) {
  expectZeroGrowthOfAllUnknowns(falling);
}

// Each branch is there once at each friction, the swept ones are the eigenvalues of the band, and
// the number of unstable ones is that of the critical frictions below.
void expectBranchesToHoldTheSweep(const Law& law) {
  for (int ranks : {1, 2}) {
    ASSERT_EQ(layersOn(ranks, law).exitCode, 0);
    const fs::path folder = layersOn(ranks, law).folder;
    const CsvTable table = readCsv(folder / "branches.csv"),
                   listed = readCsv(folder / "eigenvalues.csv");
    EXPECT_EQ(table.header,
              "active_set,branch,friction,speed,pressure,damping,growth_rate_1_per_s,angular_"
              "frequency_rad_per_s,frequency_hz,"
              "overlap,in_band,swept");
    const auto branch = table.column("branch"), friction = table.column("friction"),
               inBand = table.column("in_band"), swept = table.column("swept"),
               overlap = table.column("overlap"), at = listed.column("friction"),
               critical = readCsv(folder / "critical.csv").column("friction");
    const auto followed = eigenvaluesOf(table), wanted = eigenvaluesOf(listed);
    std::map<double, std::vector<Complex>> bands, rows;
    for (std::size_t i = 0; i < followed.size(); ++i) {
      if (i > 0 && branch[i] == branch[i - 1])
        EXPECT_GT(friction[i], friction[i - 1]);
      else
        EXPECT_EQ(branch[i], i == 0 ? 1 : branch[i - 1] + 1);
      // |tr(ΠΠ')| of oblique projectors, about 1; 0 where a branch begins.
      if (i > 0 && branch[i] == branch[i - 1])
        EXPECT_NEAR(overlap[i], 1, 0.5);
      else
        EXPECT_EQ(overlap[i], 0);
      if (swept[i] == 1 && inBand[i] == 1) bands[friction[i]].push_back(followed[i]);
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) rows[at[i]].push_back(wanted[i]);
    EXPECT_EQ(rows.size(), 5U);
    ASSERT_EQ(bands.size(), rows.size());
    for (const auto& [f, values] : rows) {
      EXPECT_EQ(bands[f].size(), values.size()) << f;
      EXPECT_LT(worst(errors(values, bands[f]).relative), 1e-8) << f;  // both to -flutter_tolerance
      const auto unstable = std::count_if(values.begin(), values.end(),
                                          [](Complex s) { return s.real() > 1e-6 * std::abs(s); });
      EXPECT_EQ(unstable, std::count_if(critical.begin(), critical.end(),
                                        [&, f = f](double c) { return c < f; }))
          << f;
    }
  }
}

TEST(Critical, BranchesHoldTheSweep) { expectBranchesToHoldTheSweep(constant); }
TEST(Critical, BranchesHoldTheSweepWhereTermsBelongToPoints) {
  expectBranchesToHoldTheSweep(falling);
}

}  // namespace
}  // namespace squeal::test
