// SPDX-License-Identifier: BSD-2-Clause
// Findings on what holds each part, and on nodes that are held twice or moved.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/system/text.hpp"
#include "support/run/audited_blocks.hpp"

namespace squeal {
namespace {

using test::missingIn;

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

TEST(Supports, AreCountedByPart) {
  const auto found = test::audited(test::twoBlocks("audit_parts.msh", 0) + test::blockContact +
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
      test::audited(test::twoBlocks("audit_links.msh", 0.03) +
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
  auto options = test::twoBlocks("audit_loose.msh", 0) + test::blockContact;
  options.erase(options.find("-constraint_pad_high_clamped xyz"),
                std::string("-constraint_pad_high_clamped xyz").size());
  const auto found = test::audited(options + "-constraint_pad_high_clamped xy");
  ASSERT_EQ(found.parts.size(), 2u);
  EXPECT_FALSE(found.parts[0].needsContact);
  EXPECT_TRUE(found.parts[1].needsContact);
}

TEST(Overconstrained, SupportsOfTiedNodes) {
  const auto options = test::twoBlocks("audit_held.msh", 0, 3) +
                       "-tie_t_slave pad_low -tie_t_master disc_high -constraint_pad_x0_clamped x";
  EXPECT_EQ(missingIn(test::audited(options), 1,
                      {"over-constrained nodes (note)", "tie 't': 3 displacements of tied nodes",
                       "'pad_low'", "'disc_high'"}),
            "");
}

TEST(Overconstrained, NodesOfTwoInterfaces) {
  const auto options = test::changed(test::twoBlocks("audit_twice.msh", 0, 3),
                                     "pad_high_clamped xyz", "pad_high_clamped yz") +
                       "-tie_t_slave pad_low -tie_t_master disc_high "
                       "-tie_t_adjust off -contact_side_pad pad_x0 "
                       "-contact_side_obstacle_velocity 0,1,0";
  EXPECT_EQ(missingIn(test::audited(options), 1,
                      {"over-constrained nodes (warning)", "interface 'side': 3 nodes of 'pad_x0'",
                       "(0, 0, 0)", "tie 't'"}),
            "");
}

TEST(Adjustment, TieThatStretchesCells) {
  const auto options = test::twoBlocks("audit_stretch.msh", 0.01, 3) +
                       "-tie_t_slave pad_low -tie_t_master disc_high -tie_t_tolerance 0.02 ";
  EXPECT_EQ(missingIn(test::audited(options), 1,
                      {"adjustment of a tie (warning)", "tie 't'", "by up to 0.01 m",
                       "stretches or compresses 6 cells", "20 %", "-tie_t_adjust off"}),
            "");
  EXPECT_EQ(missingIn(test::audited(options + "-tie_t_adjust off"), 0, {}), "");
}

}  // namespace
}  // namespace squeal
