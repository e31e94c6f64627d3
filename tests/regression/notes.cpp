// SPDX-License-Identifier: BSD-2-Clause
// Notes that a run prints beside its numbers: options it had no use for, and what they do not
// show.
#include <nlohmann/json.hpp>

#include "support/harness/bad_input.hpp"
#include "support/model/blocks_apart.hpp"

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

// A single interface whose nodes match has a line of its own if it is not hard contact.
TEST(Notes, SoftLayerAndKeptContact) {
  const Options soft = with(spoken, {{"contact_plate_stiffness", "1e3"},
                                     {"contact_plate_separation", "off"},
                                     {"contact_plate_role", "frictionless"},
                                     {"flutter_friction", "0"},
                                     {"flutter_sensitivities", "on"}});
  const ProgramRun run = runProgram("notes/soft", 1, commandLine(soft)),
                   dry =
                       runProgram("notes/soft_dry", 1, commandLine(with(soft, {{"dry_run", ""}})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_TRUE(says(run, "; with a soft layer of 1000 N/m3; they do not separate")) << run.out;
  EXPECT_TRUE(says(run, "sensitivities.csv has no rows, since no mode was found unstable"))
      << run.out;
  EXPECT_TRUE(says(dry, "soft layer of 1000 N/m3, do not separate")) << dry.out;
}

// The case displaces the pad along y; without a hold along y its displacement is left out.
TEST(Notes, DisplacementThatIsNotHeld) {
  const ProgramRun run = runProgram(
      "notes/displacement", 1,
      commandLine(with(twoLayers,
                       {{"constraint_pad_top_clamped", "x"}, {"load_pad_top_pressure", "0.02"}})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_NE(
      run.error.find(
          "option -constraint_pad_top_displacement: the displacement of y was not used, since "
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
    EXPECT_TRUE(says(run, "0.4  no eigenvalue was found, so stability is unknown")) << run.out;
    EXPECT_TRUE(says(run, "free modes in the band have no eigenvalue there")) << run.out;
  }
  const ProgramRun run = runProgram("notes/undamped", 1, commandLine(spoken));
  EXPECT_FALSE(says(run, "have no eigenvalue there")) << run.out;
}

// The plate is lifted: nothing touches the layer.
TEST(Notes, OpenContactIsNoStableSliding) {
  const ProgramRun run =
      runProgram("notes/open", 1,
                 commandLine(with(spoken, {{"contact_plate_obstacle_displacement", "0,0.01,0"}})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_TRUE(says(run, "no contact is closed, nothing slides")) << run.out;
  EXPECT_FALSE(says(run, "sliding is stable")) << run.out;
}

// The default of 200 modes is more than a small mesh has.
TEST(Notes, AllModesOfASmallMesh) {
  const ProgramRun run =
      runProgram("notes/small", 1, commandLine(without(spoken, {"modes_count"})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_TRUE(says(run, "30 modes to ")) << run.out;
  EXPECT_TRUE(says(run, "All eigenvalues: backward errors in the full-order problem")) << run.out;
  const ProgramRun limited =
      runProgram("notes/limited", 1,
                 commandLine(with(without(spoken, {"modes_count"}), {{"flutter_band", "0.001"}})));
  ASSERT_EQ(limited.exitCode, 0) << limited.error;
  EXPECT_TRUE(says(limited,
                   "All eigenvalues, as the basis is the whole space (-flutter_band was "
                   "not used): backward errors"))
      << limited.out;
}

TEST(Notes, OneModeIsCounted) {
  const ProgramRun run =
      runProgram("notes/one", 1, commandLine(with(spoken, {{"modes_count", "1"}})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_TRUE(says(run, "counted exactly by inertia")) << run.out;
}

/// A pad of length 2 that begins at x = 1/2 and y = 1/100 above a disc of length `length`, held
/// below; `interface` joins them.
Options overhang(const std::string& name, double length, const Options& interface) {
  BlockWriter writer;
  writer.add("disc", {3, {8, 1, 2}, {0, 0, -1}, {length, 1, 0}, 0});
  writer.add("pad", {3, {10, 1, 2}, {0.5, 0, 0.01}, {2.5, 1, 1}, 0});
  const fs::path file = placeFor("notes") / (name + ".msh");
  writeText(file, writer.text());
  Options options{{"mesh_file", file.string()},
                  {"constraint_disc_low_clamped", "xy"},
                  {"constraint_pad_high_clamped", "xy"},
                  {"flutter_friction", "0"},
                  {"modes_count", "4"}};
  for (const std::string body : {"disc", "pad"})
    options = with(options, {{"material_" + body + "_young", "1"},
                             {"material_" + body + "_poisson", "0.3"},
                             {"material_" + body + "_density", "1"}});
  return with(options, interface);
}

// A tie that holds less than half of its slave may be a mistake; contact may lie on a large disc.
TEST(Notes, TiesThatHoldLittleOfTheirSlave) {
  const Options tie{{"tie_glue_slave", "pad_low"}, {"tie_glue_master", "disc_high"}};
  for (const int ranks : {1, 2}) {
    const ProgramRun run =
        runProgram("notes/little", ranks, commandLine(overhang("little", 0.9, tie)));
    ASSERT_EQ(run.exitCode, 0) << run.error;
    EXPECT_NE(run.error.find("warning: tie 'glue' ties 20 % of the area of its slave 'pad_low', "
                             "0.4 of 2 m2; no part of 'disc_high' faces the rest within "
                             "-tie_glue_tolerance, half the size of a face"),
              std::string::npos)
        << run.error;
    // Two of the ten cells are above the disc.
    EXPECT_TRUE(says(run, "tie 'glue' tied: 3 nodes of 'pad_low', mortar on ")) << run.out;
    EXPECT_TRUE(says(run,
                     "20 % of the area of the 10 faces of 'pad_low' is covered, surfaces up "
                     "to 0.01 m apart; 0.4 m2 are tied, 8 nodes are not; nodes were moved by "
                     "up to 0.01 m"))
        << run.out;
    const auto entry =
        nlohmann::json::parse(contentOf(run.folder / "summary.json"))["interfaces"]["tie 'glue'"];
    EXPECT_EQ(entry["tied_nodes"], 3);
    EXPECT_EQ(entry["untied_nodes"], 8);
    EXPECT_NEAR(entry["tied_area_m2"].get<double>(), 0.4, 1e-12);
    EXPECT_NEAR(entry["slave_area_m2"].get<double>(), 2, 1e-12);
    EXPECT_NEAR(entry["largest_adjustment_m"].get<double>(), 0.01, 1e-12);
    EXPECT_EQ(entry["adjusted"], true);
  }
  const ProgramRun more =
      runProgram("notes/more", 1, commandLine(with(overhang("more", 2.1, tie), {{"dry_run", ""}})));
  ASSERT_EQ(more.exitCode, 0) << more.error;
  EXPECT_EQ(more.error.find("warning"), std::string::npos) << more.error;
  EXPECT_TRUE(says(more, "glue (9 mortar nodes, tied)")) << more.out;
  const ProgramRun contact = runProgram("notes/contact", 1,
                                        commandLine(overhang("contact", 0.9,
                                                             {{"contact_glue_pad", "pad_low"},
                                                              {"contact_glue_disc", "disc_high"},
                                                              {"contact_glue_role", "frictionless"},
                                                              {"contact_glue_slave", "pad"},
                                                              {"dry_run", ""}})));
  ASSERT_EQ(contact.exitCode, 0) << contact.error;
  EXPECT_EQ(contact.error.find("warning"), std::string::npos) << contact.error;
  EXPECT_TRUE(says(contact, "glue (3 mortar nodes)")) << contact.out;
}

}  // namespace
}  // namespace squeal::test
