// SPDX-License-Identifier: BSD-2-Clause
// The findings of the audit: one model for each kind, and clean models without any.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "run/audit/audit.hpp"
#include "support/model/blocks_apart.hpp"
#include "support/model/mesh_text.hpp"
#include "support/run/audited.hpp"

namespace squeal {
namespace {

using test::Block;
using test::missingIn;

const std::string clamped = " -constraint_disc_low_clamped xyz -constraint_pad_high_clamped xyz ";

/// Collective. Returns a mesh of one block, clamped below and in a bonded contact with nothing.
std::string block(const std::string& file, const mesh::Point& high, const std::string& young,
                  const std::string& density, const std::string& poisson = "0.3") {
  test::BlockWriter writer;
  writer.add("box", {test::hex8, {2, 2, 2}, {0, 0, 0}, high, 0});
  return "-mesh_file " + test::writeFile(file, writer.text()) +
         test::material("box", young, poisson, density) +
         "-constraint_box_low_clamped xyz -contact_plate_pad box_high "
         "-contact_plate_obstacle_velocity 1,0,0 ";
}

/// Collective. Returns two blocks, 0.1 m long, with a gap, clamped at their far sides, without
/// their interface.
std::string blocks(const std::string& file, double gap, int padCells = 2) {
  const auto options =
      test::blocksApart(file, {test::hex8, {2, 2, 1}, {0, 0, -0.05}, {0.1, 0.1, 0}, 0},
                        {test::hex8, {padCells, 2, 1}, {0, 0, gap}, {0.1, 0.1, gap + 0.05}, 0});
  return options.substr(0, options.find("-contact_")) + clamped;
}

const std::string contact = " -contact_face_pad pad_low -contact_face_disc disc_high ";

TEST(Clean, CasesHaveNoFinding) {
  for (const char* name : {"layer", "two_layers", "two_layers_antiplane"}) {
    test::setCase(name);
    EXPECT_EQ(test::linesOf(test::auditInForce()), "") << name;
  }
  test::setCase("two_layers", "-mesh_set shared=1");
  EXPECT_EQ(test::linesOf(test::auditInForce()), "");
}

TEST(Units, LengthsInMillimetres) {
  const auto options = block("audit_mm.msh", {100, 50, 10}, "2.1e11", "7850");
  EXPECT_EQ(missingIn(test::audited(options), 1,
                      {"units (warning)", "100 m from (0, 0, 0) to (100, 50, 10)",
                       "a mass of 3.925e+08 kg", "its lengths look like mm", "-mesh_scale 0.001"}),
            "");
  EXPECT_EQ(missingIn(test::audited(options + "-mesh_scale 0.001"), 0, {}), "");
}

TEST(Units, ConsistentMillimetres) {
  EXPECT_EQ(
      missingIn(test::audited(block("audit_t.msh", {100, 50, 10}, "2.1e5", "7.85e-9")), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(block("audit_t_m.msh", {0.1, 0.05, 0.01}, "2.1e5", "7.85e-9")),
                      1, {"its lengths look like m", "-mesh_scale 1000"}),
            "");
}

TEST(Units, ModulusAndDensity) {
  const mesh::Point size{0.1, 0.05, 0.01};
  EXPECT_EQ(missingIn(test::audited(block("audit_mpa.msh", size, "2.1e5", "7850")), 1,
                      {"body 'box'", "5.17 m/s", "looks like MPa or GPa", "-material_box_young"}),
            "");
  EXPECT_EQ(missingIn(test::audited(block("audit_gram.msh", size, "2.1e11", "7.85")), 1,
                      {"body 'box'", "the density looks like g/cm3", "-material_box_density"}),
            "");
  EXPECT_EQ(missingIn(test::audited(block("audit_tonne.msh", size, "2.1e11", "7.85e-9")), 1,
                      {"the density looks like t/mm3"}),
            "");
}

// The largest of the Young's moduli along the axes gives the wave speed.
TEST(Units, OrthotropicBody) {
  const auto options = block("audit_orthotropic.msh", {0.1, 0.05, 0.01}, "2.1e11", "7850");
  const auto found = test::audited(test::changed(
      test::changed(options, "-material_box_young 2.1e11", ""), "-material_box_poisson 0.3",
      "-material_box_engineering_constants 4e9,1e9,2e9,0.3,0.2,0.1,1e9,1e9,1e9"));
  EXPECT_NEAR(found.waveSpeed.at(0), std::sqrt(4e9 / 7850), 1e-9);
  EXPECT_EQ(test::linesOf(found), "");
}

// Findings name the section, and the pressure is that on the section which it loads.
TEST(Units, Sections) {
  const std::string plate =
      "-mesh_file meshes/laminate.geo -material_plate_sections lower,upper "
      "-material_plate_young 2e11 -material_plate_poisson 0.3 -material_plate_density 7800 "
      "-constraint_bottom_clamped xyz ";
  EXPECT_EQ(missingIn(test::audited(plate), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(plate + "-material_upper_density 7.8"), 1,
                      {"section 'upper' of body 'plate': a modulus", "-material_upper_density"}),
            "");
  const std::string soft = plate + "-material_upper_young 1e7 -load_top_pressure 2e6 ";
  EXPECT_EQ(missingIn(test::audited(soft), 1,
                      {"the pressure of 2e+06 Pa on 'top' of section 'upper' of body 'plate'",
                       "0.2 times its modulus of 1e+07 Pa"}),
            "");
  EXPECT_NEAR(test::audited(soft).waveSpeed.at(0), std::sqrt(2e11 / 7800), 1e-9);
  EXPECT_EQ(missingIn(test::audited(plate + "-material_upper_young 1e7 -load_left_pressure 2e6 "),
                      1, {"on 'left' of section 'upper' of body 'plate'"}),
            "");
  EXPECT_EQ(missingIn(test::audited(plate + "-material_lower_poisson 0.4999 "
                                            "-elasticity_incompatible_modes none "),
                      1, {"section 'lower' of body 'plate' is nearly incompressible"}),
            "");
}

// Two blocks 0.2 m apart are one body by name only.
TEST(Sections, ThatNothingJoins) {
  test::BlockWriter writer;
  writer.add("one", {test::hex8, {1, 1, 1}, {0, 0, 0}, {0.1, 0.1, 0.1}, 0});
  writer.add("two", {test::hex8, {1, 1, 1}, {0.3, 0, 0}, {0.4, 0.1, 0.1}, 0});
  writer.add("three", {test::hex8, {1, 1, 1}, {0, 0.3, 0}, {0.1, 0.4, 0.1}, 0});
  const std::string options = "-mesh_file " + test::writeFile("audit_apart.msh", writer.text()) +
                              test::material("bar", "2e11", "0.3", "7800") +
                              "-constraint_one_low_clamped xyz -constraint_two_low_clamped xyz "
                              "-constraint_three_low_clamped xyz ";
  EXPECT_EQ(missingIn(test::audited(options + "-material_bar_sections one,two,three"), 1,
                      {"detached sections (warning)",
                       "the sections of body 'bar' form 3 pieces that share no node", "'one'",
                       "'two'", "'three'", "merge the nodes of the sections"}),
            "");
  // A coupling joins two of them.
  EXPECT_EQ(missingIn(test::audited(options +
                                    "-material_bar_sections one,two,three -reference_r_position "
                                    "0.2,0,0 -coupling_r_reference r "
                                    "-coupling_r_nodes one_high,two_high"),
                      1, {"form 2 pieces"}),
            "");
  const auto laminate = test::audited(
      "-mesh_file meshes/laminate.geo -material_plate_sections lower,upper "
      "-material_plate_young 2e11 -material_plate_poisson 0.3 "
      "-material_plate_density 7800 -constraint_bottom_clamped xyz "
      "-reference_r_centre_of top -coupling_r_reference r -coupling_r_nodes top "
      "-coupling_r_kind distributed");
  EXPECT_EQ(test::linesOf(laminate), "");
}

// The numbers of nodes of couplings: the body has those of the group, and so has the reference node
// that they follow; a reference node that follows them is one node.
TEST(Supports, CountTheNodesOfCouplings) {
  test::BlockWriter writer;
  writer.add("box", {test::hex8, {2, 2, 2}, {0, 0, 0}, {0.1, 0.05, 0.01}, 0});
  const std::string options = "-mesh_file " + test::writeFile("audit_coupled.msh", writer.text()) +
                              test::material("box", "2.1e11", "0.3", "7850") +
                              "-constraint_box_low_clamped xyz -reference_r_centre_of box_high "
                              "-coupling_c_reference r -coupling_c_nodes box_high "
                              "-coupling_c_kind ";
  for (const std::string kind : {"rigid", "distributed"}) {
    const auto found = test::audited(options + kind);
    for (const auto& part : found.parts) {
      const auto support = std::ranges::find(part.supports, "coupling 'c'", &audit::Support::by);
      ASSERT_NE(support, part.supports.end()) << part.part;
      const bool isReference = part.part == "reference node r";
      EXPECT_EQ(support->nodes, isReference && kind == "distributed" ? 1 : 9) << part.part << kind;
    }
  }
}

TEST(Units, Pressure) {
  const auto options = block("audit_p.msh", {0.1, 0.05, 0.01}, "2.1e11", "7850");
  const std::string load = " -load_box_x0_pressure ";
  EXPECT_EQ(missingIn(test::audited(options + load + "1e6"), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(options + load + "1.5"), 1,
                      {"pressure of 1.5 Pa on 'box_x0' of body 'box'", "looks like MPa",
                       "-load_box_x0_pressure in Pa"}),
            "");
  EXPECT_EQ(missingIn(test::audited(options + load + "4.2e11"), 1,
                      {"is 2 times its modulus of 2.1e+11 Pa"}),
            "");
}

TEST(Units, Gravity) {
  const auto si = block("audit_g.msh", {0.1, 0.05, 0.01}, "2.1e11", "7850"),
             mm = block("audit_g_mm.msh", {100, 50, 10}, "2.1e5", "7.85e-9");
  EXPECT_EQ(missingIn(test::audited(si + "-load_gravity 0,0,-9.81"), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(si + "-load_gravity 0,0,-9810"), 1,
                      {"gravity of 9810 m/s2 looks like mm/s2", "-load_gravity in m/s2"}),
            "");
  EXPECT_EQ(missingIn(test::audited(mm + "-load_gravity 0,0,-9810"), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(mm + "-load_gravity 0,0,-9.81"), 1,
                      {"gravity of 9.81 m/s2 looks like m/s2", "-load_gravity in mm/s2"}),
            "");
}

TEST(Rotation, AxisFarFromTheBody) {
  const auto options =
      blocks("audit_axis.msh", 0) + contact + " -motion_disc_speed 5 -motion_disc_axis 0,0,1 ";
  EXPECT_EQ(missingIn(test::audited(options + "-motion_disc_origin 0.05,0.05,0"), 0, {}), "");
  EXPECT_EQ(
      missingIn(test::audited(options + "-motion_disc_origin 50,0.05,0"), 1,
                {"axis of rotation (warning)", "body 'disc', (0.05, 0.05, -0.025)", "49.95 m away",
                 "through (50, 0.05, 0) along (0, 0, 1)", "-motion_disc_origin"}),
      "");
  EXPECT_EQ(missingIn(test::audited(options + "-motion_disc_origin 0.06,0.05,0"), 1,
                      {"axis of rotation (note)", "0.01 m away"}),
            "");
}

// Ring and hat of the disc turn at 10 rpm about the z axis. Their moments of inertia about it are
// the sum of ρ π h (R⁴ − r⁴) / 2 over three hollow cylinders; facets make them smaller by 1 %.
TEST(Rotation, OfABodyThatACouplingHolds) {
  const double pi = std::acos(-1.0), speed = 10 * 2 * pi / 60;
  const auto cylinder = [&](double inner, double outer, double height) {
    return 7200 * pi * height * (std::pow(outer, 4) - std::pow(inner, 4)) / 2;
  };
  const double axial =
      cylinder(0.08, 0.144, 0.015) + cylinder(0.07, 0.08, 0.045) + cylinder(0.034, 0.07, 0.01);
  const auto stiffness = [&](const std::string& options) {
    test::setCase("disc_brake_rotating",
                  "-mesh_set n_pad_theta=4,n_free_theta=8,n_pad_r=2,n_mount=1 "
                  "-reference_hub_centre_of mounting -coupling_hub_reference hub "
                  "-coupling_hub_nodes mounting -bushing_hub_from hub "
                  "-bushing_hub_stiffness 1e8,1e8,1e8,1e5,1e5,1e5 " +
                      options);
    removeOption("constraint_mounting_clamped");
    const std::string lines = test::linesOf(test::auditInForce()), words = "like a spring of ";
    const auto at = lines.find(words);
    return at == std::string::npos ? 0 : std::stod(lines.substr(at + words.size()));
  };
  const double expected = -speed * speed * axial / 2;
  EXPECT_NEAR(stiffness(""), expected, 0.03 * std::abs(expected));
  EXPECT_EQ(stiffness("-motion_convective off"), 0);
  EXPECT_EQ(stiffness("-elasticity_prestress on -coupling_hub_kind distributed"), 0);
}

TEST(NearFaces, BodiesThatTouchWithoutAnInterface) {
  for (const int cells : {2, 3}) {  // node on node, or not
    const auto options = blocks("audit_touch.msh", 0, cells);
    EXPECT_EQ(
        missingIn(test::audited(options), 1,
                  {"faces without an interface (warning)", "touches body", "without an interface",
                   ", 0.01 m2, the first at (0.0", ", 0.025, 0); those of '",
                   "' are in no group that an option names", "-contact_<interface>_pad"}),
        "");
    EXPECT_EQ(missingIn(test::audited(options + contact), 0, {}), "");
    EXPECT_EQ(
        missingIn(test::audited(options + "-tie_t_slave pad_low -tie_t_master disc_high"), 0, {}),
        "");
  }
}

TEST(NearFaces, BodiesThatLieCloseAreNotes) {
  EXPECT_EQ(missingIn(test::audited(blocks("audit_close.msh", 0.002)), 1,
                      {"faces without an interface (note)", "4 faces of 'disc'",
                       "at distances from 0.002 to 0.002 m"}),
            "");
  EXPECT_EQ(missingIn(test::audited(blocks("audit_apart.msh", 0.01)), 0, {}), "");
}

// A coupling of both faces joins them; one of each to a reference node of its own does not.
TEST(NearFaces, CoupledBodies) {
  const auto options = blocks("audit_coupled.msh", 0) + "-reference_r_position 0.05,0.05,0 ";
  const std::string one = "-coupling_c_reference r -coupling_c_nodes ";
  EXPECT_EQ(missingIn(test::audited(options + one + "disc_high,pad_low"), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(options + one + "disc_high"), 1,
                      {"touches body 'pad'",
                       "; those of 'disc' are in 'disc_high'; those of 'pad' are in no group that "
                       "an option names"}),
            "");
  // A pressure names a surface group.
  EXPECT_EQ(missingIn(test::audited(options + one + "disc_high -load_pad_low_pressure 1e-6"), 1,
                      {"those of 'disc' are in 'disc_high'; those of 'pad' are in 'pad_low'"}),
            "");
}

// Two solids of one group whose meshes do not match.
TEST(NearFaces, PartsOfOneBody) {
  test::BlockWriter writer;
  writer.add("box", {test::hex8, {2, 2, 1}, {0, 0, 0}, {0.1, 0.1, 0.05}, 0});
  writer.add("box", {test::hex8, {5, 5, 1}, {0.01, 0.01, 0.05}, {0.09, 0.09, 0.1}, 0});
  EXPECT_EQ(
      missingIn(test::audited("-mesh_file " + test::writeFile("audit_two.msh", writer.text()) +
                              test::material("box", "2e11", "0.3", "7800") +
                              "-constraint_box_x0_clamped xyz"),
                1, {"(warning): a part of body 'box' touches another part of 'box'"}),
      "");
}

// In the plane the faces are lines.
TEST(NearFaces, Plane) {
  const auto options = test::blocksApart("audit_lines.msh", {3, {4, 1, 2}, {0, 0, -1}, {2, 0, 0}},
                                         {3, {5, 1, 2}, {1, 0, 0}, {3, 0, 1}});
  const std::string supports = "-constraint_disc_low_clamped xy -constraint_pad_high_clamped xy ";
  EXPECT_EQ(missingIn(test::audited(options.substr(0, options.find("-contact_")) + supports), 1,
                      {"(warning): body '", "m, the first at (1."}),
            "");
  EXPECT_EQ(missingIn(test::audited(options + supports), 0, {}), "");
}

TEST(UnmergedNodes, BodyThatIsCut) {
  test::BlockWriter writer;
  writer.add("box", {test::hex8, {2, 2, 1}, {0, 0, 0}, {0.1, 0.1, 0.05}, 0});
  writer.add("box", {test::hex8, {2, 2, 1}, {0, 0, 0.05}, {0.1, 0.1, 0.1}, 0});
  EXPECT_EQ(
      missingIn(test::audited("-mesh_file " + test::writeFile("audit_cut.msh", writer.text()) +
                              test::material("box", "2e11", "0.3", "7800") +
                              "-constraint_box_x0_clamped xyz"),
                1,
                {"unmerged nodes (warning)", "body 'box' has 18 nodes at the place of",
                 "(0, 0, 0.05)", "merge the nodes"}),
      "");
}

// The section of a bolt cuts its body as well, but the bolt joins the two sides.
TEST(UnmergedNodes, SectionOfABolt) {
  const std::string geometry = R"(
Point(1) = {0, 0, 0}; Point(2) = {0.1, 0, 0}; Point(3) = {0.1, 0.1, 0}; Point(4) = {0, 0.1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Transfinite Curve{1:4} = 3;
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Transfinite Surface{1}; Recombine Surface{1};
low[] = Extrude{0, 0, 0.1}{ Surface{1}; Layers{2}; Recombine; };
high[] = Extrude{0, 0, 0.1}{ Surface{low[0]}; Layers{2}; Recombine; };
Physical Surface("bottom") = {1};
Physical Surface("section") = {low[0]};
Physical Volume("bolt") = {low[1], high[1]};
)";
  const auto found = test::audited(
      "-mesh_file " + test::writeFile("audit_bolt.geo", geometry) +
      test::material("bolt", "2e11", "0.3", "7800") +
      "-constraint_bottom_clamped xyz -bolt_b_section section -bolt_b_shortening 1e-5");
  EXPECT_EQ(test::linesOf(found), "");
  bool isListed = false;
  for (const auto& part : found.parts)
    for (const auto& support : part.supports) isListed = isListed || support.by == "bolt 'b'";
  EXPECT_TRUE(isListed);
}

// Bodies that meet at an edge face each other nowhere.
TEST(UnmergedNodes, BodiesThatMeetAtAnEdge) {
  test::BlockWriter writer;
  writer.add("disc", {test::hex8, {2, 2, 1}, {0, 0, -0.05}, {0.1, 0.1, 0}, 0});
  writer.add("pad", {test::hex8, {2, 2, 1}, {0.1, 0, 0}, {0.2, 0.1, 0.05}, 0});
  EXPECT_EQ(
      missingIn(
          test::audited("-mesh_file " + test::writeFile("audit_edge.msh", writer.text()) +
                        test::material("disc", "2e11", "0.3", "7800") +
                        test::material("pad", "2e11", "0.3", "7800") + clamped),
          1, {"unmerged nodes (note)", "body 'disc' has 3 nodes", "of body 'pad'", "(0.1, 0, 0)"}),
      "");
}

TEST(Cells, SmallJacobian) {
  const auto text = test::changed(test::quadranglesMsh2(), "\n6 2 1 0\n", "\n6 1.4 0.4 0\n");
  const auto found =
      test::audited("-mesh_file " + test::writeFile("audit_folded.msh", text) +
                    test::material("layer", "1", "0.3", "1") + "-constraint_bottom_clamped xy");
  // det J is linear from 1 at the first corner to −0.2 at the last one: at the Gauss points
  // 0.4 ∓ 0.6/√3.
  EXPECT_NEAR(found.cells.at(0).jacobian.value,
              (0.4 - 0.6 / std::sqrt(3)) / (0.4 + 0.6 / std::sqrt(3)), 1e-12);
  EXPECT_EQ(missingIn(found, 1,
                      {"distorted cells (note)", "in 1 cell of body 'layer'",
                       "at worst to 0.072 in cell 6 (quad4) at (1.35, 0.35, 0)"}),
            "");
}

TEST(Cells, LongCells) {
  const auto found = test::audited(block("audit_long.msh", {0.5, 0.5, 0.001}, "2e11", "7800"));
  // ‖J‖ ‖J⁻¹‖/3 of a box with the sides a, a, b and k = a/b: √((2 k² + 1)(2 k⁻² + 1))/3.
  const double k = 500;
  EXPECT_NEAR(found.cells.at(0).aspect.value, std::sqrt((2 * k * k + 1) * (2 / (k * k) + 1)) / 3,
              1e-6);
  EXPECT_EQ(missingIn(found, 1,
                      {"distorted cells (note)", "8 flat or long cells of body 'box'", "in cell"}),
            "");
}

TEST(Locking, LinearCellsOfAnIncompressibleBody) {
  const auto options = block("audit_lock.msh", {0.1, 0.05, 0.01}, "2e9", "1200", "0.4999");
  EXPECT_EQ(missingIn(test::audited(options), 0, {}), "");  // hex8 has incompatible modes
  EXPECT_EQ(missingIn(test::audited(options + "-elasticity_incompatible_modes none"), 1,
                      {"locking (warning)", "body 'box'", "8 linear cells"}),
            "");
}

TEST(Overconstrained, SupportsOfTiedNodes) {
  const auto options = blocks("audit_held.msh", 0, 3) +
                       "-tie_t_slave pad_low -tie_t_master disc_high -constraint_pad_x0_clamped x";
  EXPECT_EQ(missingIn(test::audited(options), 1,
                      {"over-constrained nodes (note)", "tie 't': 3 displacements of tied nodes",
                       "'pad_low'", "'disc_high'"}),
            "");
}

TEST(Overconstrained, NodesOfTwoInterfaces) {
  const auto options = test::changed(blocks("audit_twice.msh", 0, 3), "pad_high_clamped xyz",
                                     "pad_high_clamped yz") +
                       "-tie_t_slave pad_low -tie_t_master disc_high "
                       "-tie_t_adjust off -contact_side_pad pad_x0 "
                       "-contact_side_obstacle_velocity 0,1,0";
  EXPECT_EQ(missingIn(test::audited(options), 1,
                      {"over-constrained nodes (warning)", "interface 'side': 3 nodes of 'pad_x0'",
                       "(0, 0, 0)", "tie 't'"}),
            "");
}

TEST(Adjustment, TieThatStretchesCells) {
  const auto options = blocks("audit_stretch.msh", 0.01, 3) +
                       "-tie_t_slave pad_low -tie_t_master disc_high -tie_t_tolerance 0.02 ";
  EXPECT_EQ(missingIn(test::audited(options), 1,
                      {"adjustment of a tie (warning)", "tie 't'", "by up to 0.01 m",
                       "stretches or compresses 6 cells", "20 %", "-tie_t_adjust off"}),
            "");
  EXPECT_EQ(missingIn(test::audited(options + "-tie_t_adjust off"), 0, {}), "");
}

TEST(Supports, AreCountedByPart) {
  const auto found = test::audited(blocks("audit_parts.msh", 0) + contact +
                                   " -ground_pad_y0_stiffness 1e6,1e6,1e6");
  ASSERT_EQ(found.parts.size(), 2u);
  const auto listed = [](const audit::PartSupports& part) {
    std::string text = part.part + (part.needsContact ? " loose" : " supported");
    for (const auto& support : part.supports)
      text += ", " + support.by + ": " + std::to_string(support.nodes);
    return text;
  };
  EXPECT_EQ(listed(found.parts[0]), "disc supported, support 'disc_low': 9, interface 'face': 9");
  EXPECT_EQ(listed(found.parts[1]),
            "pad supported, support 'pad_high': 9, springs of 'pad_y0': 6, interface 'face': 9");
}

TEST(Supports, SpringsAndBushings) {
  const auto found =
      test::audited(blocks("audit_links.msh", 0.03) +
                    "-reference_a_position 0.05,0.05,0 -reference_b_position 0.05,0.05,0.03 "
                    "-coupling_a_reference a -coupling_a_nodes disc_high -coupling_b_reference b "
                    "-coupling_b_nodes pad_low -spring_s_from a -spring_s_to b "
                    "-spring_s_stiffness 1e6 -bushing_t_from a -bushing_t_to b "
                    "-bushing_t_stiffness 1e6,1e6,1e6,1e3,1e3,1e3");
  for (const auto& part : found.parts) {
    if (part.part != "a" && part.part != "b") continue;
    std::vector<std::string> names;
    for (const auto& support : part.supports) names.push_back(support.by);
    EXPECT_EQ(joined(names), "bushing 't', spring 's', coupling '" + part.part + "'");
    for (const auto& support : part.supports) EXPECT_EQ(support.nodes, 1) << support.by;
  }
  EXPECT_EQ(found.parts.size(), 4u);
}

TEST(Supports, PartThatOnlyContactHolds) {
  auto options = blocks("audit_loose.msh", 0) + contact;
  options.erase(options.find("-constraint_pad_high_clamped xyz"),
                std::string("-constraint_pad_high_clamped xyz").size());
  const auto found = test::audited(options + "-constraint_pad_high_clamped xy");
  ASSERT_EQ(found.parts.size(), 2u);
  EXPECT_FALSE(found.parts[0].needsContact);
  EXPECT_TRUE(found.parts[1].needsContact);
}

TEST(Markdown, ListsFindingsMassesAndSupports) {
  const auto found = test::audited(blocks("audit_markdown.msh", 0));
  const std::string text = audit::markdown(found);
  for (const char* piece :
       {"# Audit of the model\n", "1. **Warning, faces without an interface**: body '",
        "*Remedy:* if the parts touch there", "| disc | 4 | 0.0005 | (0.05, 0.05, -0.025) |",
        "| total | 8 | 0.001 | (0.05, 0.05, 0) |", "| disc | support 'disc_low': 9 | supported |"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
  EXPECT_EQ(audit::summaryOf(found), "1 warning");
}

}  // namespace
}  // namespace squeal
