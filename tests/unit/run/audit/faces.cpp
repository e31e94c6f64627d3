// SPDX-License-Identifier: BSD-2-Clause
// Findings on faces that touch without an interface and on nodes that coincide.
#include <gtest/gtest.h>

#include "support/run/audited_blocks.hpp"

namespace squeal {
namespace {

using test::missingIn;

TEST(NearFaces, BodiesThatTouchWithoutAnInterface) {
  for (const int cells : {2, 3}) {  // node on node, or not
    const auto options = test::twoBlocks("audit_touch.msh", 0, cells);
    EXPECT_EQ(
        missingIn(test::audited(options), 1,
                  {"faces without an interface (warning)", "touches body", "without an interface",
                   ", 0.01 m2, the first at (0.0", ", 0.025, 0); those of '",
                   "' are in no group that an option names", "-contact_<interface>_pad"}),
        "");
    EXPECT_EQ(missingIn(test::audited(options + test::blockContact), 0, {}), "");
    EXPECT_EQ(
        missingIn(test::audited(options + "-tie_t_slave pad_low -tie_t_master disc_high"), 0, {}),
        "");
  }
}

TEST(NearFaces, BodiesThatLieCloseAreNotes) {
  EXPECT_EQ(missingIn(test::audited(test::twoBlocks("audit_close.msh", 0.002)), 1,
                      {"faces without an interface (note)", "4 faces of 'disc'",
                       "at distances from 0.002 to 0.002 m"}),
            "");
  EXPECT_EQ(missingIn(test::audited(test::twoBlocks("audit_far.msh", 0.01)), 0, {}), "");
}

// A coupling of both faces joins them; one of each to a reference node of its own does not.
TEST(NearFaces, CoupledBodies) {
  const auto options =
      test::twoBlocks("audit_joined.msh", 0) + "-reference_r_position 0.05,0.05,0 ";
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
                        test::material("pad", "2e11", "0.3", "7800") + test::clampedBlocks),
          1, {"unmerged nodes (note)", "body 'disc' has 3 nodes", "of body 'pad'", "(0.1, 0, 0)"}),
      "");
}

}  // namespace
}  // namespace squeal
