// SPDX-License-Identifier: BSD-2-Clause
// Options of joints that have no effect are named.
#include "run/analysis/idle_options.hpp"

#include <gtest/gtest.h>

#include "support/harness/messages.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

const std::string model = "-mesh_file meshes/beam.geo -mesh_set nx=4,Ly=0.4,Lz=0.3 " +
                          test::material("beam", "2e11", "0.3", "8000") +
                          "-constraint_clamped_clamped xyz -reference_end_position 1,0,0 "
                          "-coupling_end_reference end -coupling_end_nodes tip ";

/// Collective. Returns the warnings of building the model with these options.
std::string warningsWith(const std::string& options) {
  test::setOptions(model + options);
  return test::warningsOf(
      [] { analysis::buildModel(PETSC_COMM_WORLD, analysis::ModelSettings::given()); });
}

TEST(IdleOptions, AreNamed) {
  const std::vector<std::pair<std::string, std::string>> idle{
      {"-frame_f_x 0,1,0 ",
       "option -frame_f_x was not used: no other option refers to the frame 'f'"},
      {"-frame_f_axis 0,1,0 ",
       "option -frame_f_axis was not used: no other option refers to the frame 'f'"},
      {"-frame_f_x 0,1,0 -frame_f_xy 1,0,0 -frame_f_origin 1,2,3 -bushing_b_from end "
       "-bushing_b_stiffness 1,2,3 -bushing_b_frame f ",
       "option -frame_f_origin was not used: the axes of a rectangular frame are the same "
       "everywhere"},
      {"-coupling_end_pinned on ",
       "option -coupling_end_pinned was not used: none of the coupled nodes is a reference node, "
       "so none has a rotation"},
      {"-frame_f_axis 0,1,0 -frame_f_origin 0,5,5 -coupling_end_frame f ",
       "option -coupling_end_frame was not used: all components are coupled"},
      {"-frame_f_axis 0,1,0 -frame_f_origin 0,5,5 -mass_end_total 1 -mass_end_frame f ",
       "option -mass_end_frame was not used: the mass has no inertia and no offset"},
      {"-constraint_end_clamped_rotation x -constraint_end_angle 0,0.01,0 ",
       "option -constraint_end_angle: the angle about y was not used, since "
       "-constraint_end_clamped_rotation x does not hold it"},
      {"-motion_beam_velocity 1,0,0 ",
       "option -motion_beam_velocity was not used: without contact and -motion_convective on a "
       "translation has no effect"},
      {"-motion_beam_speed 1 -load_centrifugal off ",
       "option -motion_beam_speed was not used: without contact, -load_centrifugal and "
       "-motion_convective a motion has no effect"},
      {"-elasticity_plane stress ", "option -elasticity_plane was not used: the mesh is solid"}};
  for (const auto& [options, message] : idle) {
    const std::string found = warningsWith(options);
    EXPECT_TRUE(test::contains(found, message)) << options << "\n  " << found;
  }
}

// Nothing that a factor on the speed would scale.
TEST(IdleOptions, SpeedOfNothingIsRefused) {
  const std::string flutter = "-flutter_friction 0 -modes_count 2 -flutter_speed ",
                    refusal = "option -flutter_speed scales the motion of bodies and obstacles";
  const auto message = [&](const std::string& options) {
    return test::errorOf([&] { test::runOptions(model + flutter + options); });
  };
  EXPECT_TRUE(test::contains(message("1,2"), refusal)) << message("1,2");
  EXPECT_TRUE(test::contains(message("2 -motion_beam_velocity 1,0,0"), refusal));
  EXPECT_EQ(message("1"), "");
  EXPECT_EQ(message("1,2 -motion_beam_speed 1"), "");  // centrifugal forces
}

TEST(IdleOptions, UsedOnesAreNotNamed) {
  EXPECT_EQ(warningsWith("-motion_beam_speed 1 "), "");
  EXPECT_EQ(warningsWith("-frame_f_axis 0,1,0 -frame_f_origin 0,5,5 -coupling_end_frame f "
                         "-coupling_end_components xy -bushing_b_from end "
                         "-bushing_b_stiffness 1,1,1,1,1,1 -mass_end_total 1 -mass_end_frame f "
                         "-mass_end_offset 0,0,1 -reference_hub_position 2,0,0 "
                         "-coupling_hub_reference hub -coupling_hub_nodes end "
                         "-coupling_hub_pinned on -frame_g_x 0,1,0 -frame_g_xy 1,0,0 "
                         "-load_end_force 1,0,0 -load_end_frame g "
                         "-constraint_hub_clamped_rotation xyz -constraint_hub_angle 0,0.04,0 "),
            "");
}

// The turned arm of length 1 is (cos θ, sin θ), the linear one (1, θ): at 0.3 rad the difference is
// 0.04489 of a chord of 0.29888.
TEST(IdleOptions, LargeTurnsAreReported) {
  const std::string held = "-constraint_end_clamped_rotation xyz ";
  EXPECT_TRUE(test::contains(
      warningsWith(held + "-constraint_end_angle 0,0.3,0 "),
      "warning: option -constraint_end_angle: rotations are linear, so a turn of 0.3 rad gives the "
      "nodes that follow it displacements with a relative error of 0.15"));
  EXPECT_TRUE(test::contains(warningsWith(held + "-constraint_end_angle 0.04,-0.04,0 "),
                             "a turn of 0.0566 rad"));
}

}  // namespace
}  // namespace squeal
