// SPDX-License-Identifier: BSD-2-Clause
// Elements that a mesh holds twice: what they contribute would be doubled, so they are errors.
#include <gtest/gtest.h>

#include "model/mesh/twins.hpp"
#include "support/harness/messages.hpp"
#include "support/model/mesh_text.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using test::changed;
using test::expectMessage;
using test::messageOfMesh;

const std::string layer = test::material("layer", "1", "0.3", "1");

TEST(MeshTwins, TheSameElementTwiceIsAnError) {
  const std::string two = test::quadranglesMsh2();
  // In one group, with the corners in another order.
  std::string text = changed(changed(two, "$Elements\n6", "$Elements\n7"), "$EndElements",
                             "9 3 2 3 1 2 5 4 1\n$EndElements");
  expectMessage(messageOfMesh(test::writeFile("cell_twice.msh", text), layer),
                {"the cells 5 of group 'layer' and 9 of group 'layer'", "the same nodes"});
  // In two groups, entities of their own.
  text = changed(changed(two, "$Elements\n6", "$Elements\n7"), "$EndElements",
                 "9 3 2 4 7 1 2 5 4\n$EndElements");
  text = changed(changed(text, "$PhysicalNames\n3", "$PhysicalNames\n4"), "2 3 \"layer\"",
                 "2 4 \"copy\"\n2 3 \"layer\"");
  expectMessage(messageOfMesh(test::writeFile("cell_in_two.msh", text),
                              layer + test::material("copy", "1", "0.3", "1")),
                {"5 of group 'layer'", "9 of group 'copy'", "the same nodes"});
  // A triangle quadratic and linear: the corners are the same.
  text = changed(changed(two, "$Elements\n6", "$Elements\n8"), "$EndElements",
                 "8 2 2 3 1 1 2 4\n9 9 2 4 7 1 2 4 3 5 6\n$EndElements");
  text = changed(changed(text, "$PhysicalNames\n3", "$PhysicalNames\n4"), "2 3 \"layer\"",
                 "2 4 \"copy\"\n2 3 \"layer\"");
  expectMessage(messageOfMesh(test::writeFile("two_orders.msh", text),
                              layer + test::material("copy", "1", "0.3", "1")),
                {"8 of group 'layer'", "9 of group 'copy'"});
  // A face: pressure on it would count twice.
  text = changed(changed(two, "$Elements\n6", "$Elements\n7"), "$EndElements",
                 "9 1 2 2 2 5 4\n$EndElements");
  expectMessage(
      messageOfMesh(test::writeFile("face_twice.msh", text), layer + "-load_top_pressure 1"),
      {"faces 3 and 9", "'top'"});
  EXPECT_EQ(
      messageOfMesh(test::writeFile("face_twice.msh", text), layer + "-constraint_top_clamped xy"),
      "");  // nodes are held once
  // A cell that repeats a node.
  text = changed(two, "5 3 2 3 1 1 2 5 4", "5 3 2 3 1 1 2 5 5");
  expectMessage(messageOfMesh(test::writeFile("collapsed.msh", text), layer),
                {"cell 5 of group 'layer'", "a node twice"});
}

// Two cells between the same corners are two where their edges are curved.
TEST(MeshTwins, CellsWithTheSameCornersMayDiffer) {
  mesh::WholeBlock halves{16,     8,     4, {0, 1, 2, 3, 4, 5, 6, 7, 1, 0, 3, 2, 8, 7, 9, 5},
                          {0, 0}, {1, 2}};
  EXPECT_FALSE(mesh::findTwins({halves}));
  halves.nodes[8 + 4] = 4, halves.nodes[8 + 6] = 6;
  EXPECT_TRUE(mesh::findTwins({halves}));
}

}  // namespace
}  // namespace squeal
