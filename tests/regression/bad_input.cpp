// SPDX-License-Identifier: BSD-2-Clause
// Mistakes in the input: what the program says of each, on all ranks. That it then ends with exit
// code 1, and leaves no results behind, is a matter of command_line.cpp.
#include "support/harness/bad_input.hpp"
#include "support/model/mesh_text.hpp"

namespace squeal::test {
namespace {

// Without this, a mistake in the cases themselves would pass for the mistake they are about.
TEST(BadInput, BaseCasesAreSound) {
  const fs::path place = placeFor("bad_input/meshes");
  writeOnce(place / "apart.geo", squares("4", "5"));
  writeOnce(place / "matching.geo", squares("4", "4"));
  writeOnce(place / "sound.msh", twoQuadrangles(false));
  const Options quadrangles =
      with(without(layer, {"mesh_set", "constraint_right_image_of"}),
           {{"mesh_file", (place / "sound.msh").string()}, {"modes_count", "2"}});
  const std::map<std::string, Options> cases{
      {"layer", layer},
      {"two_layers", twoLayers},
      {"squares", onSquares(place / "matching.geo")},
      {"squares_apart", onSquares(place / "apart.geo")},
      {"quadrangles", quadrangles},
      {"periodic_squares", periodicSquares(place / "matching.geo")}};
  for (const auto& [name, options] : cases) {
    EXPECT_EQ(refusalOf(options), "") << name;
  }
}

TEST(BadInput, Options) {
  expectRefused({
      {"unknown",
       with(layer, {{"flutter_frictions", "0.2"}}),
       {"unknown option -flutter_frictions", "did you mean -flutter_friction?"}},
      {"unknown_of_group",
       with(layer, {{"material_layer_yung", "1"}}),
       {"unknown option -material_layer_yung", "did you mean -material_layer_young?"}},
      {"unknown_word",
       with(layer, {{"brake_pedal", "1"}}),
       {"unknown option -brake_pedal", "-help"}},
      {"steady_solver",
       with(layer, {{"steady_snes_foo", "1"}}),
       {"-steady_snes_foo", "unknown to the solver", "-steady_"}},
      {"modes_solver",
       with(layer, {{"modes_eps_foo", "1"}}),
       {"-modes_eps_foo", "unknown to the solver", "-modes_eps_"}},
      {"factorisation",
       with(layer, {{"modes_st_foo", "1"}}),
       {"-modes_st_foo", "unknown to the solver", "-modes_st_"}},
      {"direct_solver",
       with(layer, {{"flutter_method", "direct"}, {"flutter_eps_foo", "1"}}),
       {"-flutter_eps_foo", "unknown to the solver"}},
      {"solver_that_does_not_run", with(layer, {{"flutter_eps_foo", "1"}}), {"-flutter_eps_foo"}},
      {"factorisation_direct",
       with(layer, {{"flutter_method", "direct"}, {"modes_st_foo", "1"}}),
       {"-modes_st_foo"}},
      // PETSc and SLEPc find these out as they set their solvers up.
      {"solver_number",
       with(layer, {{"modes_eps_tol", "abc"}}),
       {"-modes_eps_tol abc", "no numeric value"}},
      {"solver_type", with(layer, {{"modes_eps_type", "foo"}}), {"-modes_eps_type foo"}},
      {"solver_size",
       with(layer, {{"modes_eps_ncv", "3"}}),
       {"-modes_eps_ncv 3", "at least nev+1"}},
      {"solver_of_bounds",
       with(layer, {{"steady_snes_type", "newtonls"}}),
       {"-steady_snes_type newtonls", "bounds"}},
      {"steady_inner_solver", with(layer, {{"steady_ksp_type", "foo"}}), {"-steady_ksp_type foo"}},
      {"factor_type",
       with(layer, {{"modes_st_ksp_type", "gmress"}}),
       {"-modes_st_ksp_type gmress"}},
      {"factor_package",
       with(layer, {{"modes_st_pc_factor_mat_solver_type", "foo"}}),
       {"-modes_st_pc_factor_mat_solver_type foo"}},
      {"factor_ordering",
       with(layer, {{"modes_st_mat_mumps_icntl_7", "999"}}),
       {"-modes_st_mat_mumps_icntl_7 999"}},
      {"direct_type",
       with(layer, {{"flutter_method", "direct"}, {"flutter_st_type", "foo"}}),
       {"-flutter_st_type foo"}},
      {"method",
       with(layer, {{"flutter_method", "qz"}}),
       {"-flutter_method qz", "must be reduced or direct"}},
      {"mass",
       with(layer, {{"elasticity_mass", "lumped"}}),
       {"-elasticity_mass lumped", "must be consistent or higher_order"}},
      {"count_zero", with(layer, {{"modes_count", "0"}}), {"-modes_count 0", "an integer >= 1"}},
      {"count_real",
       with(layer, {{"modes_count", "1.5"}}),
       {"-modes_count 1.5", "an integer >= 1"}},
      {"count_too_large",
       with(layer, {{"modes_count", "100000"}}),
       {"-modes_count 100000", "30 unknowns"}},
      {"friction_negative",
       with(layer, {{"flutter_friction", "-0.1"}}),
       {"-flutter_friction -0.1", "numbers >= 0"}},
      {"friction_no_step",
       with(layer, {{"flutter_friction", "0:0.6"}}),
       {"-flutter_friction 0:0.6", "first:last:step"}},
      {"friction_zero_step",
       with(layer, {{"flutter_friction", "0:0.6:0"}}),
       {"-flutter_friction 0:0.6:0", "first:last:step"}},
      {"friction_backwards",
       with(layer, {{"flutter_friction", "0.6:0:0.1"}}),
       {"-flutter_friction 0.6:0:0.1", "first:last:step"}},
      {"friction_word",
       with(layer, {{"flutter_friction", "0,high"}}),
       {"-flutter_friction", "'high'", "a comma-separated list"}},
      {"friction_gap",
       with(layer, {{"flutter_friction", "0.2,,0.4"}}),
       {"-flutter_friction", "a comma-separated list"}},
      {"friction_empty", with(layer, {{"flutter_friction", ""}}), {"-flutter_friction", "empty"}},
      {"report_frames",
       with(layer, {{"report_frames", "1"}}),
       {"-report_frames 1", "an integer >= 4"}},
      {"options_file",
       with(layer, {{"options_file", "options/nosuch.yaml"}}),
       {"-options_file options/nosuch.yaml"}},
      {"no_options", {}, {"-material_<group>_young"}},
  });
}

TEST(BadInput, Material) {
  expectRefused({
      {"density_negative",
       with(layer, {{"material_layer_density", "-1"}}),
       {"-material_layer_density -1", "mass density", "must be a number > 0"}},
      {"poisson_half",
       with(layer, {{"material_layer_poisson", "0.5"}}),
       {"-material_layer_poisson 0.5", "Poisson", "> -1 and < 0.5"}},
      {"young_zero",
       with(layer, {{"material_layer_young", "0"}}),
       {"-material_layer_young 0", "Young", "must be a number > 0"}},
      {"young_negative",
       with(layer, {{"material_layer_young", "-2e11"}}),
       {"-material_layer_young -2e11", "must be a number > 0"}},
      {"young_word",
       with(layer, {{"material_layer_young", "steel"}}),
       {"-material_layer_young 'steel'", "must be a number > 0"}},
      {"young_with_unit",
       with(layer, {{"material_layer_young", "2e11Pa"}}),
       {"-material_layer_young '2e11Pa'", "must be a number > 0"}},
      {"young_nan",
       with(layer, {{"material_layer_young", "nan"}}),
       {"-material_layer_young 'nan'", "must be a number > 0"}},
      {"density_missing",
       without(layer, {"material_layer_density"}),
       {"-material_layer_density is missing", "mass density"}},
      {"without_material",
       without(with(layer, {{"mesh_file", "meshes/two_layers.geo"},
                            {"mesh_set", "nx=6,ny_disc=3,ny_pad=3"},
                            {"material_disc_young", "1"},
                            {"material_disc_poisson", "0.3"},
                            {"material_disc_density", "1"}}),
               {"material_layer_young", "material_layer_poisson", "material_layer_density"}),
       {"group 'pad' has no material", "-material_<group>_young"}},
      {"motion_of_no_body",
       with(layer, {{"motion_disk_velocity", "1,0,0"}}),
       {"-motion_disk_velocity", "'disk' is not a body"}},
      {"motion_twice",
       with(layer, {{"motion_layer_velocity", "1,0,0"}, {"motion_layer_speed", "1"}}),
       {"-motion_layer_velocity", "-motion_layer_speed", "not both"}},
  });
}

TEST(BadInput, Mesh) {
  const fs::path place = placeFor("bad_input/meshes");
  const auto file = [&](const std::string& name) { return (place / name).string(); };
  writeOnce(place / "syntax.geo", "Point(1) = {0, 0, 0;\nLine(1) = {1, 2};\n");
  writeOnce(place / "inverted.msh", twoQuadrangles(true));
  writeOnce(place / "not_a_mesh.msh", "hello\n");
  writeOnce(place / "cubic.geo",
            "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1}; Physical "
            "Surface(\"layer\") = {1};\n"
            "Transfinite Surface {1}; Recombine Surface {1}; Mesh.ElementOrder = 3;\n");
  writeOnce(place / "script.msh", "SystemCall \"touch '" + file("script_ran") + "'\";\n");
  writeOnce(place / "crash.msh",
            changed(quadranglesMsh4(), "1 1 \"bottom\"", "900000000 1 \"bottom\""));
  expectRefused({
      {"mesh_file",
       with(layer, {{"mesh_file", "meshes/nosuch.geo"}}),
       {"-mesh_file meshes/nosuch.geo", "no such file"}},
      {"mesh_file_missing", without(layer, {"mesh_file"}), {"-mesh_file is missing"}},
      {"geo_syntax",
       without(with(layer, {{"mesh_file", file("syntax.geo")}}), {"mesh_set"}),
       {"-mesh_file", "syntax.geo", "syntax error"}},
      {"geo_syntax_with_parameters",
       with(layer, {{"mesh_file", file("syntax.geo")}}),
       {"-mesh_file", "syntax.geo", "syntax error"}},
      {"not_a_mesh",
       without(with(layer, {{"mesh_file", file("not_a_mesh.msh")}}), {"mesh_set"}),
       {"-mesh_file", "not_a_mesh.msh"}},
      {"mesh_set_value",
       with(layer, {{"mesh_set", "nx=many"}}),
       {"-mesh_set nx=many", "name=number"}},
      {"mesh_set_name",
       with(layer, {{"mesh_set", "mx=6"}}),
       {"-mesh_set mx=6", "no parameter 'mx'", "nx"}},
      {"mesh_set_range",
       with(layer, {{"mesh_set", "nx=0,ny=3"}}),
       {"-mesh_set nx=0", "must be a whole number >= 1"}},
      {"cubic_cells",
       without(with(layer, {{"mesh_file", file("cubic.geo")}}), {"mesh_set"}),
       {"has cells 'Quadrilateral 16'", "quad9"}},
      {"script",
       without(with(layer, {{"mesh_file", file("script.msh")}}), {"mesh_set"}),
       {"-mesh_file", "does not begin with '$MeshFormat'"}},
      {"crash",
       without(with(layer, {{"mesh_file", file("crash.msh")}}), {"mesh_set"}),
       {"-mesh_file", "gmsh crashed ("}},
      {"inverted",
       with(without(layer, {"mesh_set", "constraint_right_image_of"}),
            {{"mesh_file", file("inverted.msh")}, {"modes_count", "2"}}),
       {"inverted element", "cell 6", "'layer'"}},
      {"body_group",
       with(layer, {{"material_pad_young", "1"},
                    {"material_pad_poisson", "0.3"},
                    {"material_pad_density", "1"}}),
       {"-material_pad_young", "'pad', which is not in the mesh", "layer"}},
      {"contact_gap",
       with(layer, {{"contact_plate_gap", "wide"}}),
       {"-contact_plate_gap 'wide'", "'measured' or a number"}},
      {"contact_group",
       with(layer, {{"contact_plate_pad", "topp"}}),
       {"-contact_plate_pad", "'topp', which is not in the mesh", "top"}},
      {"constraint_group",
       with(layer, {{"constraint_botom_clamped", "xy"}}),
       {"-constraint_botom_", "'botom', which is not in the mesh"}},
      {"load_group",
       with(layer, {{"load_roof_pressure", "1"}}),
       {"-load_roof_pressure", "'roof', which is not in the mesh"}},
      {"load_on_body",
       with(layer, {{"load_layer_pressure", "1"}}),
       {"-load_layer_pressure", "dimension 2"}},
  });
  EXPECT_FALSE(fs::exists(place / "script_ran"));
}

TEST(BadInput, Constraints) {
  const fs::path place = placeFor("bad_input/meshes");
  writeOnce(place / "sides_3_2.geo", squares("4", "4", "3"));
  writeOnce(place / "sides_1_2.geo", squares("4", "4", "1"));
  expectRefused({
      {"loose_layer",
       without(layer, {"constraint_bottom_clamped"}),
       {"body 'layer' can move rigidly", "-constraint_<group>_clamped"}},
      {"loose_pad",
       without(
           with(onSquares("meshes/two_layers.geo"), {{"mesh_set", "nx=6,ny_disc=3,ny_pad=3"},
                                                     {"constraint_disc_bottom_clamped", "xy"},
                                                     {"load_pad_top_pressure", "1"}}),
           {"constraint_bottom_clamped", "constraint_top_clamped", "constraint_top_displacement"}),
       {"body 'pad' can move rigidly", "-constraint_<group>_clamped"}},
      {"components",
       with(layer, {{"constraint_bottom_clamped", "xyz"}}),
       {"-constraint_bottom_clamped 'xyz'", "letters xy"}},
      {"displacement_not_clamped",
       with(layer, {{"constraint_left_displacement", "1,0,0"}}),
       {"-constraint_left_displacement needs -constraint_left_clamped"}},
      {"displacement_short",
       with(layer, {{"constraint_bottom_displacement", "1"}}),
       {"-constraint_bottom_displacement", "2 components"}},
      {"image_of_itself",
       with(layer, {{"constraint_right_image_of", "right"}}),
       {"-constraint_right_image_of right", "its own image"}},
      {"image_of_nothing",
       with(layer, {{"constraint_right_image_of", "nothing"}}),
       {"-constraint_right_image_of", "'nothing', which is not in the mesh"}},
      {"image_finer",
       periodicSquares(place / "sides_3_2.geo"),
       {"-constraint_right_image_of left", "meshed alike"}},
      {"image_coarser",
       periodicSquares(place / "sides_1_2.geo"),
       {"-constraint_right_image_of left", "meshed alike"}},
  });
}

TEST(BadInput, Contact) {
  const fs::path place = placeFor("bad_input/meshes");
  writeOnce(place / "faces_4_5.geo", squares("4", "5"));
  writeOnce(place / "inside.geo",
            "Point(1) = {0, -1, 0}; Point(2) = {1, -1, 0}; Point(3) = {1, 0, 0}; Point(4) = {0, 0, "
            "0}; Point(5) = {1, 1, 0}; "
            "Point(6) = {0, 1, 0};\n"
            "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {3, "
            "5}; Line(6) = {5, 6}; Line(7) = "
            "{6, 4};\n"
            "Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(1) = {1}; "
            "Plane Surface(2) = {2};\n"
            "Physical Curve(\"bottom\") = {1}; Physical Curve(\"inside\") = {3}; Physical "
            "Curve(\"disc_face\") = {6};\n"
            "Physical Surface(\"disc\") = {1, 2};\n");
  writeOnce(place / "matching.geo", squares("4", "4"));
  expectRefused({
      {"no_slip_obstacle",
       without(layer, {"contact_plate_obstacle_velocity"}),
       {"|w| = 0", "'plate'", "-contact_plate_obstacle_velocity"}},
      {"slip_along_normal",
       with(layer, {{"contact_plate_obstacle_velocity", "0,1,0"}}),
       {"|w| = 0", "'plate'"}},
      {"no_slip_disc",
       without(onSquares(place / "matching.geo"), {"motion_disc_velocity"}),
       {"|w| = 0", "'face'", "-motion_<body>_velocity"}},
      {"held_across",
       with(layer, {{"constraint_top_clamped", "y"}}),
       {"holds component y", "not tangential", "-constraint_top_clamped"}},
      {"neither",
       without(layer, {"contact_plate_obstacle_velocity", "contact_plate_obstacle_displacement"}),
       {"-contact_plate_pad", "-contact_plate_disc", "-contact_plate_obstacle_velocity"}},
      {"both",
       with(layer, {{"contact_plate_disc", "bottom"}}),
       {"-contact_plate_pad", "-contact_plate_disc"}},
      {"no_pad",
       with(layer, {{"contact_other_disc", "bottom"}}),
       {"-contact_other_disc needs -contact_other_pad"}},
      {"pad_is_disc",
       with(onSquares(place / "matching.geo"), {{"contact_face_pad", "disc_face"}}),
       {"-contact_face_pad disc_face", "pad and disc are the same surface", "two"}},
      {"pad_inside",
       with(without(onSquares(place / "inside.geo"),
                    {"material_pad_young", "material_pad_poisson", "material_pad_density",
                     "constraint_top_clamped", "constraint_top_displacement"}),
            {{"contact_face_pad", "inside"}}),
       {"-contact_face_pad", "'inside' lies inside the body 'disc'"}},
      {"pad_twice",
       with(layer, {{"contact_other_pad", "top"}, {"contact_other_obstacle_velocity", "1,0,0"}}),
       {"both contain the node at ("}},
      {"shared_both_rest",
       with(without(onSquares("meshes/two_layers.geo"),
                    {"motion_disc_velocity", "constraint_bottom_clamped", "constraint_top_clamped",
                     "constraint_top_displacement"}),
            {{"mesh_set", "nx=6,ny_disc=3,ny_pad=3,shared=1"},
             {"constraint_disc_bottom_clamped", "xy"},
             {"constraint_pad_top_clamped", "xy"}}),
       {"-contact_face_pad", "share the nodes", "-motion_<body>_"}},
  });
}

/// The squares with other cells on both faces, and the upper one moved.
std::string movedSquares(const std::string& right, const std::string& up) {
  const std::string text =
      changed(squares("4", "5"),
              "Point(5) = {0, 0, 0}; Point(6) = {1, 0, 0}; Point(7) = {1, 1, 0}; "
              "Point(8) = {0, 1, 0};",
              "Point(5) = {0 + x, 0 + y, 0}; Point(6) = {1 + x, 0 + y, 0}; Point(7) = {1 + x, 1 + "
              "y, 0}; Point(8) = {0 + x, 1 + y, 0};");
  return "x = " + right + "; y = " + up + ";\n" + text;
}

// Surfaces that are meshed apart, and that are no contact.
TEST(BadInput, ContactOfMeshesThatDoNotMatch) {
  const fs::path place = placeFor("bad_input/meshes_apart");
  for (const auto& [name, right, up] :
       {std::array{"close", "0", "0.05"}, {"far", "0", "0.2"}, {"beside", "1.5", "0"}})
    writeOnce(place / (std::string(name) + ".geo"), movedSquares(right, up));
  const Options close = onSquares(place / "close.geo"), far = onSquares(place / "far.geo"),
                beside = onSquares(place / "beside.geo");
  // Half a face is 0.1 on the finer side.
  const std::vector<std::string> apart{"-contact_face_pad pad_face", "-contact_face_disc disc_face",
                                       "no part of 'pad_face' faces a part of 'disc_face'",
                                       "-contact_face_search"};
  const auto together = [](std::vector<std::string> words, const std::string& more) {
    words.push_back(more);
    return words;
  };
  expectRefused({
      {"looking_away",
       with(close, {{"contact_face_pad", "top"}, {"contact_face_search", "3"}}),
       {"-contact_face_pad top", "no part of 'top' faces a part of 'disc_face'",
        "-contact_face_search 3 m"}},
      {"too_far", far, together(apart, "half the size of a face")},
      {"too_far_by_option", with(close, {{"contact_face_search", "0.04"}}),
       together(apart, "-contact_face_search 0.04 m")},
      {"side_by_side", beside, apart},
      {"side_by_side_searched_far", with(beside, {{"contact_face_search", "9"}}), apart},
      {"slave_held_across",
       with(close, {{"constraint_pad_face_clamped", "y"}}),
       {"-constraint_pad_face_clamped holds component y", "not tangential"}},
      {"disc_held_across",
       with(close, {{"contact_face_slave", "disc"}, {"constraint_disc_face_clamped", "y"}}),
       {"-constraint_disc_face_clamped holds component y", "not tangential"}},
      {"claimed_twice",
       with(close, {{"contact_other_pad", "pad_face"}, {"contact_other_disc", "disc_face"}}),
       {"'face'", "'other'", "both contain the node at (", "a node has only one gap"}},
      {"with_itself",
       with(close, {{"contact_face_disc", "pad_face"}}),
       {"-contact_face_pad pad_face", "pad and disc are the same surface"}},
      {"slave_and_master",
       with(close, {{"contact_face_slave", "pad"},
                    {"contact_other_pad", "pad_face"},
                    {"contact_other_disc", "disc_face"},
                    {"contact_other_slave", "disc"}}),
       {"interface '", "slave"}},
  });
}

}  // namespace
}  // namespace squeal::test
