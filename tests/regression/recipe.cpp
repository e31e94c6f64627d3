// SPDX-License-Identifier: BSD-2-Clause
// The recipe of a run, options.txt: it repeats the run, and its options can be overridden.
#include "support/harness/same_on_ranks.hpp"
#include "support/run/layer_run.hpp"

namespace squeal::test {
namespace {

/// One run that several tests read.
const ProgramRun& layerRun() {
  static const ProgramRun run = runLayer("recipe", "-report_fields off");
  return run;
}

TEST(Outputs, RecipeRepeatsTheRun) {
  const ProgramRun layers = runProgram(
      "recipe/two_layers", 1,
      "-options_file options/two_layers.yaml -mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 21 "
      "-flutter_friction 0.1:0.5:0.2 -report_fields off");
  ASSERT_EQ(layers.exitCode, 0) << layers.error;
  for (const auto& [run, ranks] : {std::pair{&layerRun(), 2}, {&layers, 1}}) {
    SCOPED_TRACE(run->folder.string());
    const std::string recipe = (run->folder / "options.txt").string();
    const ProgramRun again = runProgram("recipe/again", ranks, "-options_file '" + recipe + "'");
    EXPECT_EQ(again.exitCode, 0) << again.error;
    if (again.exitCode != 0) continue;
    // Not to the letter: on two ranks MUMPS adds in the order in which messages arrive.
    const auto first = readCsv(run->folder / "eigenvalues.csv"),
               second = readCsv(again.folder / "eigenvalues.csv");
    const auto size = first.column("angular_frequency_rad_per_s");
    for (const char* column : {"friction", "growth_rate_1_per_s", "angular_frequency_rad_per_s"}) {
      const auto a = first.column(column), b = second.column(column);
      ASSERT_GE(a.size(), 30U);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a[i], b[i], 1e-9 * size[i]) << column << " of row " << i;
    }
    EXPECT_EQ(contentOf(again.folder / "options.txt"), contentOf(recipe));
  }
}

TEST(Outputs, RecipeHoldsEveryOption) {
  const ProgramRun run = runProgram(
      "recipe/solver", 1,
      coarseLayer +
          "-flutter_friction 0.4 -modes_eps_ncv 60 -steady_snes_max_it 7 -report_fields off "
          "-report_frames 8 -steady_full -quiet");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const std::string recipe = contentOf(run.folder / "options.txt");
  for (const char* line : {"-modes_eps_ncv 60\n", "-steady_snes_max_it 7\n", "-report_fields off\n",
                           "-report_frames 8\n", "-mesh_set nx=12,ny=4\n", "-modes_count 21\n"})
    EXPECT_NE(recipe.find(line), std::string::npos) << line;
  EXPECT_NE(recipe.find("\n-steady_full"), std::string::npos);
  EXPECT_EQ(recipe.find("\n-steady_full off"), std::string::npos);
  EXPECT_FALSE(fs::exists(run.folder / "vtk"));
  EXPECT_FALSE(fs::exists(run.folder / "results.h5"));
}

TEST(Outputs, CommandLineOverridesTheFile) {
  const ProgramRun run = runProgram(
      "recipe/override", 1,
      coarseLayer + "-flutter_friction 0.1 -material_layer_young 4 -quiet -report_fields off");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto modes = readCsv(run.folder / "modes.csv").column("frequency_hz"),
             before = readCsv(layerRun().folder / "modes.csv").column("frequency_hz");
  ASSERT_EQ(modes.size(), 21U);  // the file says 200
  for (std::size_t i = 0; i < modes.size(); ++i)
    EXPECT_NEAR(modes[i], 2 * before[i], 1e-9 * modes[i]);  // stiffness times 4
  const auto friction = readCsv(run.folder / "eigenvalues.csv").column("friction");
  EXPECT_GE(friction.size(), 10U);
  EXPECT_EQ(std::count(friction.begin(), friction.end(), 0.1), static_cast<long>(friction.size()));
}

}  // namespace
}  // namespace squeal::test
