// SPDX-License-Identifier: BSD-2-Clause
// Cases that contact must refuse: bodies that nothing holds, constraints and interfaces that
// contradict each other.
#include <gtest/gtest.h>

#include "support/harness/messages.hpp"
#include "support/model/contact_cases.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using test::contains;
using test::errorOf;
using test::contact_cases::layers;

const std::string cylinderBodies =
    "-mesh_file meshes/cylinders.geo -mesh_set n_inner=2,n_outer=2,n_theta=16" +
    test::material("inner", "1", "0.3", "1") + test::material("outer", "1", "0.3", "1");
const std::string cylinders = cylinderBodies +
                              "-contact_ring_pad outer_face -contact_ring_disc inner_face "
                              "-constraint_sym_x_clamped x -constraint_sym_y_clamped y";

/// The case of two layers without one of its options.
std::string messageWithout(const std::string& option) {
  test::setCase("two_layers", layers);
  removeOption(option.substr(1));
  if (option == "-constraint_pad_top_clamped") removeOption("constraint_pad_top_displacement");
  return errorOf([] { test::buildModel(); });
}

// Closed contact holds a body across the interface only: without friction it slides away.
TEST(Loose, BodyIsNamed) {
  auto message = messageWithout("-constraint_pad_top_clamped");
  EXPECT_TRUE(contains(message, "body 'pad' can move rigidly") &&
              contains(message, "-constraint_<group>_clamped"))
      << message;
  message = messageWithout("-constraint_disc_bottom_clamped");
  EXPECT_TRUE(contains(message, "body 'disc' can move rigidly")) << message;
  EXPECT_EQ(messageWithout("-quiet"), "");
  // Only across, or only along: both leave one motion.
  test::setCase("two_layers", layers + " -constraint_pad_top_clamped y");
  EXPECT_TRUE(contains(errorOf([] { test::buildModel(); }), "'pad'"));
  test::setCase("two_layers",
                layers + " -constraint_pad_top_clamped x -constraint_pad_top_displacement 0,0,0");
  EXPECT_EQ(errorOf([] { test::buildModel(); }), "");  // contact holds y
  // A cylinder in another one: free to turn unless a line of each is held.
  test::setOptions(cylinders);
  EXPECT_EQ(errorOf([] { test::buildModel(); }), "");
  for (const char* line : {"-constraint_sym_x_clamped", "-constraint_sym_y_clamped"})
    removeOption(line + 1);
  EXPECT_TRUE(contains(errorOf([] { test::buildModel(); }), "can move rigidly"));
}

// A tie of the two surfaces leaves no node to their contact.
TEST(Interfaces, AreNotBondedAsAWhole) {
  test::setCase("two_layers", layers + " -tie_glue_slave pad_face -tie_glue_master disc_face");
  const auto message = errorOf([] { test::buildModel(); });
  for (const char* words : {"interface 'interface': no node of 'pad_face' is left",
                            " are bonded to", "by tie 'glue'; remove one of the two"})
    EXPECT_TRUE(contains(message, words)) << message;
}

// Meshes need not match, but one side must lie before the other.
TEST(Interfaces, MustFaceEachOther) {
  test::setCase("two_layers", layers + " -contact_interface_pad pad_top");
  const auto message = errorOf([] { test::buildModel(); });
  for (const char* words :
       {"options -contact_interface_pad pad_top, -contact_interface_disc disc_face: no part of "
        "'pad_top' faces a part of 'disc_face'",
        "-contact_interface_search"})
    EXPECT_TRUE(contains(message, words)) << message;
}

// A third component that is left out is not a zero, and a fourth one means nothing.
TEST(Vectors, HaveAsManyComponentsAsTheMesh) {
  const std::string box = "-mesh_file meshes/beam.geo -mesh_set nx=2,ny=1,nz=1 " +
                          test::material("beam", "1", "0.3", "1") +
                          "-constraint_bottom_clamped xyz -contact_plate_pad top ",
                    velocity = "-contact_plate_obstacle_velocity 1,0,0 ";
  const auto message = [](const std::string& options) {
    test::setOptions(options);
    return errorOf([] { test::buildModel(); });
  };
  EXPECT_EQ(message(box + velocity + "-constraint_bottom_displacement 0,0,1e-3"), "");
  for (const std::string option :
       {"motion_beam_velocity", "motion_beam_axis", "motion_beam_origin",
        "constraint_bottom_displacement", "ground_bottom_stiffness",
        "contact_plate_obstacle_velocity", "contact_plate_obstacle_displacement"})
    for (const std::string value : {"1", "1,0", "1,0,0,0"}) {
      const bool turns = option == "motion_beam_axis" || option == "motion_beam_origin";
      const std::string found = message(box + velocity + (turns ? "-motion_beam_speed 1 " : "") +
                                        "-" + option + " " + value);
      EXPECT_TRUE(contains(found, "option -" + option + " " + value) &&
                  contains(found, "3 components"))
          << found;
    }
  // In the plane a third one may be left out, no second one.
  for (const std::string option : {"motion_disc_velocity", "constraint_disc_bottom_displacement"})
    for (const std::string value : {"1", "1,0", "1,0,0", "1,0,0,0"}) {
      test::setCase("two_layers", layers + " -" + option + " " + value);
      const std::string found = errorOf([] { test::buildModel(); });
      EXPECT_EQ(contains(found, "option -" + option) && contains(found, "2 components"),
                value == "1" || value == "1,0,0,0")
          << found;
    }
}

TEST(Contact, BadInputIsNamed) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"-constraint_pad_face_clamped y",
       "-contact_interface_slave disc"},  // contact decides the normal component
      {"-constraint_pad_top_clamped xz", "-constraint_pad_top_clamped"},
      {"-constraint_pad_top_clamped xyy", "-constraint_pad_top_clamped 'xyy': y twice"},
      {"-constraint_pad_top_clamped xyxyy", "'xyxyy': x twice; must be some of the letters xy"},
      {"-contact_second_disc disc_face", "needs -contact_second_pad"},
      {"-contact_second_pad pad_top", "either -contact_second_disc or"},
      {"-contact_interface_obstacle_velocity 1,0,0", "either"},
  };
  for (const auto& [change, words] : mistakes) {
    test::setCase("two_layers", layers + " " + change);
    const auto message = errorOf([] { test::buildModel(); });
    EXPECT_TRUE(contains(message, words)) << change << ": " << message;
  }
  // A round face on a flat plate.
  test::setOptions(cylinderBodies +
                   "-constraint_inner_bore_clamped xy -contact_rim_pad outer_rim "
                   "-contact_rim_obstacle_velocity 1,0,0");
  EXPECT_TRUE(contains(errorOf([] { test::buildModel(); }), "must be flat"));
}

// A drum that turns about a point beside it; the facets of a linear mesh about the true axis are no
// such motion.
TEST(Sliding, SurfaceThatMovesThroughItself) {
  const std::string drum =
      "-options_file " SQUEAL_SOURCE_DIR "/tests/inputs/axis_beside_drum/case.yaml ";
  const auto warnings = [&](const std::string& more) {
    test::setOptions(drum + more);
    return test::warningsOf([] { test::buildModel(); });
  };
  const auto beside = warnings("");
  EXPECT_TRUE(contains(beside,
                       "warning: interface 'lining': body 'drum' moves through its own contact "
                       "surface: the component of its velocity along the normal is 62 % of its "
                       "magnitude on average, 96 % at (0.35, -0.113397, 0); check "
                       "-motion_drum_origin and _axis\n"))
      << beside;
  for (const char* mesh : {"-mesh_set order=1,cells=12 ", "-mesh_set cells=12 "})
    EXPECT_EQ(warnings(mesh + std::string("-motion_drum_origin 0.3,-0.2,0")), "");
  const auto nearly = warnings("-mesh_set order=1 -motion_drum_origin 0.305,-0.2,0");
  EXPECT_TRUE(contains(nearly, "along the normal is 3.1 % of its magnitude on average")) << nearly;
  test::setOptions(drum + "-motion_drum_origin 0.304,-0.2,0 -motion_convective on");
  const auto convective = errorOf([] { test::buildModel(); });
  EXPECT_TRUE(contains(convective,
                       "option -motion_convective: interface 'lining': body 'drum' moves through "
                       "its own contact surface: ") &&
              contains(convective, "use -motion_convective off"))
      << convective;
}

TEST(Sliding, ObstacleThatMovesIntoThePad) {
  test::setOptions("-mesh_file meshes/layer.geo -mesh_set nx=6,ny=3 " +
                   test::material("layer", "1", "0.3", "1") +
                   "-constraint_bottom_clamped xy -contact_plate_pad top "
                   "-contact_plate_obstacle_velocity 1,-0.05");
  const auto warning = test::warningsOf([] { test::buildModel(); });
  EXPECT_TRUE(contains(warning,
                       "warning: interface 'plate': the rigid obstacle moves through its own "
                       "contact surface: the component of its velocity along the normal is 5 % of "
                       "its magnitude on average, 5 % at (") &&
              contains(warning, "; check -contact_plate_obstacle_velocity\n"))
      << warning;
}

}  // namespace
}  // namespace squeal
