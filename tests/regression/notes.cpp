// Notes that a run prints beside its numbers: options it had no use for, and what they do not
// show.
#include "support/bad_input.hpp"

namespace squeal::test {
namespace {

const Options spoken = without(layer, {"quiet"});

bool says(const ProgramRun& run, const std::string& text) {
  return run.out.find(text) != std::string::npos;
}

TEST(Notes, OptionsThatNothingAsksFor) {
  for (const int ranks : {1, 2}) {
    const ProgramRun run =
        runProgram("notes/unused", ranks,
                   commandLine(with(spoken, {{"flutter_direct_count", "30"},
                                             {"report_matrices_format", "petsc"},
                                             {"steady_uniqueness_eps_tol", "1e-6"},
                                             {"flutter_shapes_below", "100"}})));
    ASSERT_EQ(run.exitCode, 0) << run.error;
    EXPECT_TRUE(says(run, "option -flutter_direct_count 30 was not used")) << run.out;
    EXPECT_TRUE(says(run, "option -report_matrices_format petsc was not used")) << run.out;
    EXPECT_TRUE(says(run, "option -steady_uniqueness_eps_tol 1e-6 was not used"))
        << run.out;  // a small contact: LAPACK
    std::size_t count = 0;
    for (auto at = run.out.find("was not used"); at != std::string::npos;
         at = run.out.find("was not used", at + 1))
      ++count;
    EXPECT_EQ(count, 3u) << run.out;
  }
  const fs::path file = placeFor("notes") / "case.yaml";
  writeText(file, "flutter:\n  direct_count: 30\n");
  const ProgramRun run =
      runProgram("notes/of_file", 1, commandLine(with(spoken, {{"options_file", file.string()}})));
  EXPECT_TRUE(
      says(run, "option -flutter_direct_count 30 (" + file.string() + ", line 2) was not used"))
      << run.out;
}

// The case displaces the pad along y; without a hold along y its displacement is left out.
TEST(Notes, DisplacementThatIsNotHeld) {
  const ProgramRun run = runProgram(
      "notes/displacement", 2,
      commandLine(with(twoLayers,
                       {{"constraint_pad_top_clamped", "x"}, {"load_pad_top_pressure", "0.02"}})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_NE(run.error.find(
                "option -constraint_pad_top_displacement: the displacement of y was not used, as "
                "-constraint_pad_top_clamped x does not hold it"),
            std::string::npos)
      << run.error;
}

// A layer that is damped beyond all vibration: every free mode becomes two real eigenvalues.
TEST(Notes, NoEigenvalueIsNoStability) {
  const Options damped =
      with(spoken, {{"material_layer_rayleigh_stiffness", "10"}, {"modes_count", "8"}});
  for (const std::string friction : {"0.4", "0.2,0.4"}) {
    const ProgramRun run =
        runProgram("notes/damped", 1, commandLine(with(damped, {{"flutter_friction", friction}})));
    ASSERT_EQ(run.exitCode, 0) << run.error;
    EXPECT_FALSE(says(run, "sliding is stable")) << run.out;
    EXPECT_TRUE(says(run, "0.4  no eigenvalue was found: nothing is known of stability"))
        << run.out;
    EXPECT_TRUE(says(run, "free modes in the band have no eigenvalue there")) << run.out;
  }
  const ProgramRun run = runProgram("notes/undamped", 1, commandLine(spoken));
  EXPECT_FALSE(says(run, "have no eigenvalue there")) << run.out;
}

// The plate is lifted: nothing touches the layer.
TEST(Notes, OpenContactIsNoStableSliding) {
  const ProgramRun run =
      runProgram("notes/open", 2,
                 commandLine(with(spoken, {{"contact_plate_obstacle_displacement", "0,0.01,0"}})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_TRUE(says(run, "no contact is closed, nothing slides")) << run.out;
  EXPECT_FALSE(says(run, "sliding is stable")) << run.out;
}

// The default of 200 modes is more than a small mesh has.
TEST(Notes, AllModesOfASmallMesh) {
  const ProgramRun run =
      runProgram("notes/small", 2, commandLine(without(spoken, {"modes_count"})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_TRUE(says(run, "30 modes to ")) << run.out;
  EXPECT_TRUE(says(run, "All eigenvalues, of the full-order problem")) << run.out;
}

TEST(Notes, OneModeIsCounted) {
  const ProgramRun run =
      runProgram("notes/one", 1, commandLine(with(spoken, {{"modes_count", "1"}})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_TRUE(says(run, "count confirmed by inertia")) << run.out;
}

}  // namespace
}  // namespace squeal::test
