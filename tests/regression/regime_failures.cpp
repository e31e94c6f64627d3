// SPDX-License-Identifier: BSD-2-Clause
// What a march cannot do is refused before it, by name and bound; what fails at one point or start
// leaves the others, and the certified stages, as they are; a request to stop is obeyed at once.
#include <gtest/gtest.h>

#include <cmath>

#include "support/harness/hdf5_reader.hpp"
#include "support/harness/running_program.hpp"
#include "support/regime/regime_cases.hpp"

namespace squeal::test {
namespace {

ProgramRun failing(const std::string& name, int ranks, const Options& changes) {
  return runProgram("regime_failures_" + name, ranks, commandLine(with(blockBrake, changes)));
}

/// The run has measured nothing, which its exit code says: its row has no figures of a motion, and
/// what flutter has found is whole.
void expectNothingMeasured(const ProgramRun& run, const std::string& why) {
  EXPECT_EQ(run.exitCode, 2) << run.error;
  EXPECT_NE(run.error.find(why), std::string::npos) << run.error;
  EXPECT_NE((run.out + run.error).find("nothing measured"), std::string::npos) << run.out;
  const auto table = readCsv(run.folder / "regime.csv");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.words("class").at(0), "nothing measured");
  for (const char* column :
       {"carrier_hz", "growth_rate_1_per_s", "largest_kinetic_energy_j", "friction_coefficient",
        "friction_power_w", "open_nodes", "sticking_nodes", "largest_defect", "energy_imbalance",
        "mean_square_velocity_m2_per_s2", "sound_power_estimate_w", "sound_power_level_db"})
    EXPECT_EQ(table.words(column).at(0), "") << column;
  for (const char* name : {"regime_nodes.csv", "regime_cycles.csv", "regime_spectrum.csv"})
    EXPECT_TRUE(readCsv(run.folder / name).rows.empty()) << name;
  const auto growth = readCsv(run.folder / "eigenvalues.csv").column("growth_rate_1_per_s");
  EXPECT_EQ(std::ranges::count_if(growth, [](double g) { return g > 0; }), 4);
  for (const std::string& text : {run.out, contentOf(run.folder / "summary.json")})
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

// 0.002 s of 1e-40 s are 2e37 steps, and no step of 1e-40 s changes the time at all.
TEST(RegimeFailures, TooManyStepsAreCounted) {
  const ProgramRun run = failing("tiny", 1, {{"regime_step", "1e-40"}});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_NE(run.error.find("about 2e+37 steps for 0.002 s, more than the 1e+08"), std::string::npos)
      << run.error;
  EXPECT_FALSE(fs::exists(run.folder));
  // By default a march of this mode takes 400 of its cycles, 400 / 18828 s = 0.02124 s.
  expectNothingMeasured(failing("tiny_step", 1, {{"regime_step", "1e-30"}, {"regime_time", "0"}}),
                        "about 2.1e+28 steps");
  expectNothingMeasured(failing("forever", 1, {{"regime_time", "1e6"}}), "steps for 1e+06 s");
}

TEST(RegimeFailures, TooLongAStepNamesTheStableOne) {
  expectNothingMeasured(failing("long", 2, {{"regime_step", "1"}}),
                        "-regime_step 1 s exceeds 6.6e-06 s, the stable step");
  // The scheme that is always stable must resolve the mode: 1 / (16 · 18828 Hz) = 3.32e-6 s.
  expectNothingMeasured(
      failing("long_mass", 1, {{"regime_step", "4e-6"}, {"regime_boundary", "mass"}}),
      "-regime_step 4e-06 s exceeds 3.32e-06 s, 1/16 of the period of 18828 Hz");
}

// The first window has 32 cycles of 18828 Hz, 1.7 ms.
TEST(RegimeFailures, TooShortATimeMeasuresNothing) {
  expectNothingMeasured(failing("short", 2, {{"regime_time", "0.001"}}),
                        "-regime_time 0.001 s is shorter than the first window, 32 cycles");
}

// Marches of three starts on two ranks; each has a group of its own.
TEST(RegimeFailures, EachStartHasItsFields) {
  const ProgramRun run = failing(
      "starts", 2, {{"regime_starts", "each"}, {"regime_time", "0.0028"}, {"report_fields", "on"}});
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto table = readCsv(run.folder / "regime.csv");
  ASSERT_EQ(table.words("start"), (std::vector<std::string>{"13", "11", "6"}));
  Reader file(run.folder / "results.h5");
  const std::string point = "/regime/friction_0.5";
  EXPECT_EQ(file.attribute<double>(point, "friction", PETSC_DOUBLE), 0.5);
  for (const auto& start : table.words("start")) {
    const std::string group = point + "/start_" + start;
    EXPECT_EQ(file.attribute<double>(group, "friction", PETSC_DOUBLE), 0.5);
    double shares = 0;  // of the time, of all nodes
    for (const char* name : {"open", "stick", "slip"})
      for (const double value : file.reals(group, name).first) shares += value;
    EXPECT_NEAR(shares, 24, 1e-9);
    EXPECT_TRUE(
        fs::exists(run.folder / "vtk" / ("regime_means_friction_0.5_start_" + start + ".pvtu")));
  }
}

// At friction 2.363 the fastest growing modes diverge, and there is no cycle to count; 0.01 is
// stable; at 3 there is no steady sliding. What is found at 0.5 stays. At 2.3807 the equations of
// the active set are singular, and before it round-off changes the slow divergent eigenvalues:
// with two kernels of OpenBLAS the reduced model reproduced them to between 2e-10 and 6e-9, hence
// the tolerance of this run.
TEST(RegimeFailures, EachPointFailsForItself) {
  const std::string frictions = "0.01,0.5,2.363,3";
  const ProgramRun run = failing("points", 2,
                                 {{"flutter_friction", frictions},
                                  {"regime_friction", frictions},
                                  {"flutter_tolerance", "1e-7"}});
  EXPECT_EQ(run.exitCode, 2) << run.error;
  const auto table = readCsv(run.folder / "regime.csv");
  ASSERT_EQ(table.column("friction"), (std::vector<double>{0.5, 2.363}));
  EXPECT_EQ(table.words("class"), (std::vector<std::string>{"irregular", "nothing measured"}));
  EXPECT_EQ(table.words("flutter_frequency_hz").at(1), "0.000000000e+00");
  EXPECT_NE(run.out.find("friction 0.01: no mode is unstable"), std::string::npos);
  for (const char* text :
       {"friction 2.363, start on mode 4: nothing measured: the mode grows without oscillation",
        "friction 3: not followed after flutter (-regime_friction): no steady sliding state"})
    EXPECT_NE(run.error.find(text), std::string::npos) << run.error;
}

// With 400 modes of 438 unknowns nothing is left for the massless boundary. The band is that of the
// other runs, which have 40 modes.
TEST(RegimeFailures, AModelThatCannotBeMadeLeavesFlutter) {
  expectNothingMeasured(
      failing("model", 2, {{"modes_count", "400"}, {"flutter_band", "24400"}}),
      "friction 0.5: not followed after flutter (nothing measured): stage regime: "
      "the free modes contain the whole motion of the contact");
}

// Of 206 modes the highest has 2/ω = 1.84e-6 s, less than 1/16 of the period of 18.6 kHz.
TEST(RegimeFailures, TooFewStepsOfAPeriodicMotionAreRefused) {
  const ProgramRun run = failing("cycle", 1,
                                 {{"modes_count", "200"},
                                  {"flutter_band", "24400"},
                                  {"regime_step", "1e-6"},
                                  {"regime_cycle", "on"},
                                  {"regime_cycle_steps", "16"}});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_NE(run.error.find("friction 0.5, start on mode 13: no periodic motions: "
                           "-regime_cycle_steps 16: their length, 3.36e-06 s, exceeds"),
            std::string::npos)
      << run.error;
  EXPECT_EQ(readCsv(run.folder / "regime.csv").words("class").at(0), "irregular");
}

// Nodes are open in steady sliding at friction 1.5: the march begins without them.
TEST(RegimeFailures, OpenNodesAreFollowed) {
  const ProgramRun run =
      failing("open", 2,
              {{"flutter_friction", "1.5"}, {"regime_friction", "1.5"}, {"regime_time", "0.0035"}});
  EXPECT_EQ(run.exitCode, 0) << run.error;
  const auto steady = readCsv(run.folder / "steady_1.5.csv").words("state");
  EXPECT_EQ(std::ranges::count(steady, "open"), 2);
  const auto table = readCsv(run.folder / "regime.csv");
  EXPECT_LE(valueOf(table, "model_error"), 1e-8);
  EXPECT_GT(valueOf(table, "open_nodes"), 0);
}

// 10 s are 5e7 steps, hours of time integration on rank 0 only; rank 1, which waits, receives the
// request to stop. Each rank checks for it at least once per step.
TEST(RegimeFailures, StopsWithinASecond) {
  const std::string name = "regime_failures_stop";
  fs::remove_all(placeFor(name));
  Started run(name, 2, commandLine(with(blockBrake, {{"regime_time", "10"}})));
  ASSERT_TRUE(run.printed("regime"));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // within the march
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(kill(run.rank(1), SIGUSR1), 0);
  const auto results = run.folder() / "interrupted" / "summary.json";
  EXPECT_TRUE(waitUntil([&] { return fs::exists(results); }, 20));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(taken.count(), 1.0) << "with the writing of what is found";
  const ProgramRun ended = run.finished(20);
  EXPECT_EQ(ended.exitCode, 3) << ended.error;
}

}  // namespace
}  // namespace squeal::test
