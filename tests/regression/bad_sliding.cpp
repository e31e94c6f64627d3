// SPDX-License-Identifier: BSD-2-Clause
// Mistakes about how bodies slide on each other: motions, their speed, and the friction law.
#include "support/harness/bad_input.hpp"

namespace squeal::test {
namespace {

TEST(BadSliding, FrictionLaw) {
  const Options exponential = with(
                    layer, {{"friction_law", "exponential"}, {"friction_static_ratio", "1.5"}}),
                table = with(layer, {{"friction_law", "table"},
                                     {"friction_table_speed", "0,1"},
                                     {"friction_table_factor", "2,1"}});
  expectRefused({
      {"law",
       with(layer, {{"friction_law", "stribeck"}}),
       {"-friction_law stribeck", "must be constant or exponential or table"}},
      {"law_ratio",
       with(layer, {{"friction_static_ratio", "1.5"}}),
       {"-friction_static_ratio", "exponential", "'constant'"}},
      {"law_decay",
       with(table, {{"friction_decay_speed", "2"}}),
       {"-friction_decay_speed", "exponential", "'table'"}},
      {"law_table_speed",
       with(exponential, {{"friction_table_speed", "0,1"}}),
       {"-friction_table_speed", "-friction_law table", "'exponential'"}},
      {"law_table_factor",
       with(layer, {{"friction_table_factor", "1"}}),
       {"-friction_table_factor", "-friction_law table", "'constant'"}},
      {"law_decay_zero",
       with(exponential, {{"friction_decay_speed", "0"}}),
       {"-friction_decay_speed 0", "a number > 0"}},
      {"law_lengths",
       with(table, {{"friction_table_speed", "0,1,2"}}),
       {"-friction_table_speed", "-friction_table_factor", "the same length"}},
      {"law_order",
       with(table, {{"friction_table_speed", "1,1"}}),
       {"-friction_table_speed", "must ascend"}},
  });
}

TEST(BadSliding, Speed) {
  expectRefused({
      {"speed_zero", with(layer, {{"flutter_speed", "0"}}), {"-flutter_speed 0", "numbers > 0"}},
      {"speed_negative",
       with(layer, {{"flutter_speed", "1,-2"}}),
       {"-flutter_speed", "-2", "numbers > 0"}},
      {"speed_twice", with(layer, {{"flutter_speed", "2,1,2"}}), {"-flutter_speed", "given twice"}},
      {"speed_empty", with(layer, {{"flutter_speed", ""}}), {"-flutter_speed", "empty"}},
  });
}

// All sliding interfaces have their own coefficient, so no result would depend on the swept one.
TEST(BadSliding, FrictionOfNoInterface) {
  const Options fixed = with(layer, {{"contact_plate_friction", "0.3"}});
  expectRefused({
      {"friction_of_none",
       with(fixed, {{"flutter_friction", "0.4"}}),
       {"-flutter_friction", "no interface has", "-contact_<interface>_friction"}},
      {"regime_friction_of_none",
       with(fixed, {{"regime_friction", "0.4"}}),
       {"-regime_friction", "no interface has", "-contact_<interface>_friction"}},
  });
}

TEST(BadSliding, FactorOfNothing) {
  const Options unpressed = with(layer, {{"contact_plate_obstacle_displacement", "0,0,0"}});
  expectRefused({
      {"damping_of_none",
       with(layer, {{"flutter_damping", "1,2"}}),
       {"-flutter_damping", "there is none", "rayleigh"}},
      {"damping_negative",
       with(layer, {{"flutter_damping", "-1"}}),
       {"-flutter_damping", "-1", "numbers >= 0"}},
      {"pressure_of_nothing",
       with(unpressed, {{"flutter_pressure", "2"}}),
       {"-flutter_pressure", "hydraulic loads", "there are none", "-load_<group>_pressure",
        "_force or _moment", "_hydraulic off"}},
      {"pressure_zero",
       with(layer, {{"flutter_pressure", "0,1"}}),
       {"-flutter_pressure", "0", "numbers > 0"}},
      {"pressure_twice",
       with(layer, {{"flutter_pressure", "1,1"}}),
       {"-flutter_pressure", "given twice"}},
  });
}

TEST(BadSliding, Motion) {
  const fs::path place = placeFor("bad_sliding");
  writeOnce(place / "matching.geo", squares("4", "4"));
  const Options squaresAtWork = onSquares(place / "matching.geo"),
                turning = with(without(squaresAtWork, {"motion_disc_velocity"}),
                               {{"motion_disc_speed", "1"}});
  // The axis of the disc goes through a contact node.
  const Options slabs =
      with(without(turning, {"constraint_bottom_clamped", "constraint_top_clamped",
                             "constraint_top_displacement"}),
           {{"mesh_file", "meshes/two_slabs.geo"},
            {"mesh_set", "nx=6,ny_disc=2,ny_pad=2"},
            {"constraint_disc_bottom_clamped", "xyz"},
            {"constraint_pad_top_clamped", "xyz"},
            {"constraint_pad_top_displacement", "0,-0.01,0"},
            {"motion_disc_axis", "0,1,0"},
            {"motion_disc_origin", "1,0,0.5"}});
  const Options still =
      with(without(layer, {"contact_plate_obstacle_velocity"}), {{"flutter_friction", "0"}});
  expectRefused({
      {"plate_at_rest_without_friction",
       still,
       {"interface 'plate' slides, but |w| = 0 at all its nodes",
        "-contact_plate_obstacle_velocity", "-contact_plate_role frictionless"}},
      {"disc_at_rest_without_friction",
       with(without(squaresAtWork, {"motion_disc_velocity"}), {{"flutter_friction", "0"}}),
       {"interface 'face' slides, but |w| = 0 at all its nodes", "-motion_<body>_velocity",
        "-contact_face_role sticking or frictionless"}},
      {"convective_translation",
       with(squaresAtWork, {{"motion_convective", "on"}}),
       {"-motion_convective", "body 'disc' is not a figure of revolution", "surface at (",
        "-motion_convective off"}},
      {"convective_rotation",
       with(turning, {{"motion_convective", "on"}}),
       {"-motion_convective", "body 'disc' is not a figure of revolution", "surface at (",
        "-motion_convective off"}},
      {"no_slip_on_the_axis",
       slabs,
       {"|w| = 0", "contact node at (1, 0, 0.5)", "interface 'face'", "-motion_<body>_velocity"}},
      {"axis_without_length",
       with(turning, {{"motion_disc_axis", "0,0,0"}}),
       {"-motion_disc_axis", "no length"}},
      {"speed_and_rpm",
       with(turning, {{"motion_disc_rpm", "1"}}),
       {"-motion_disc_speed", "-motion_disc_rpm", "once"}},
  });
}

}  // namespace
}  // namespace squeal::test
