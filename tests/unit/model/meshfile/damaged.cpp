// SPDX-License-Identifier: BSD-2-Clause
// Damaged mesh files: the error names the line, the node or the element.
#include <gtest/gtest.h>

#include "support/harness/messages.hpp"
#include "support/model/layer_file.hpp"
#include "support/model/mesh_text.hpp"

namespace squeal {
namespace {

using test::changed;
using test::expectMessage;
using test::layer;
using test::messageOf;

struct Damage {
  const char *was, *is;
  std::vector<std::string> words;
};

// What gmsh's reader makes of these: a crash, another mesh without a word, or numbers that fit no
// array.
TEST(MeshFile, DamagedMshIsToldByLine) {
  const Damage ofVersion4[] = {
      {"\n3\n4\n", "\n-1\n4\n", {"line 21", "node tag -1"}},
      {"\n3\n4\n", "\n0\n4\n", {"line 21", "node tag 0"}},
      {"\n3\n4\n", "\n2\n4\n", {"$Nodes has the tag 2 twice"}},
      // beyond 32-bit indices; with 64 bits, a tag that no element refers to
      {"\n3\n4\n",
       "\n3000000000\n4\n",
       {sizeof(PetscInt) == 4 ? "node tag 3000000000" : "refers to node 3"}},
      {"5 1 2 5 4", "5 1 2 -1 4", {"element 5", "node -1"}},
      {"5 1 2 5 4", "5 1 2 7 4", {"element 5", "node 7"}},
      {"5 1 2 5 4", "6 1 2 5 4", {"$Elements has the tag 6 twice"}},
      {"2 1 0\n$EndNodes", "2 nan 0\n$EndNodes", {"node 6", "nan"}},
      {"2 1 0\n$EndNodes", "2 1e200 0\n$EndNodes", {"node 6", "1e+200", "below 1e100"}},
      {"2 1 0\n$EndNodes", "2,5 1 0\n$EndNodes", {"line 30", "'2,5'"}},
      {"2 1 0\n$EndNodes", "2 4.0D+2 0\n$EndNodes", {"'4.0D+2'"}},
      {"1 6 1 6\n2 1 0 6",
       "1 2000000000 1 6\n2 1 0 6",
       {"2000000000 nodes are promised", "cannot hold"}},
      {"1 6 1 6\n2 1 0 6", "1 5 1 6\n2 1 0 6", {"the blocks of the section hold more"}},
      {"1 6 1 6\n2 1 0 6", "1 7 1 6\n2 1 0 6", {"1 fewer nodes"}},
      {"1 6 1 6\n2 1 0 6", "0 6 1 6\n2 1 0 6", {"6 fewer nodes"}},
      {"3 6 1 6\n1 1 1 2", "2 6 1 6\n1 1 1 2", {"2 fewer elements"}},
      {"2 1 3 2\n", "2 1 77 2\n", {"element type 77"}},
      {"2 1 3 2\n", "2 9 3 2\n", {"gmsh reports", "entity 9"}},
      {"$EndElements\n", "", {"$EndElements", "nothing"}},
      {"2 3 6 5\n$EndElements\n", "2 3", {"the file ends"}},
      {"4.1 0 8", "7 0 8", {"version 7"}},
  };
  for (const auto& [was, is, words] : ofVersion4)
    expectMessage(
        messageOf(test::writeFile("damaged4.msh", changed(test::quadranglesMsh4(), was, is))),
        words);
  const Damage ofVersion2[] = {
      {"3 2 0 0", "-1 2 0 0", {"line 14", "node tag -1"}},
      {"3 2 0 0", "2 2 0 0", {"$Nodes has the tag 2 twice"}},
      {"3 2 0 0", "3 inf 0 0", {"node 3", "inf"}},
      {"$Nodes\n6", "$Nodes\n5", {"line 17", "$EndNodes is expected"}},
      {"$Nodes\n6", "$Nodes\n7", {"'$EndNodes'"}},
      {"$Elements\n6",
       "$Elements\n5",
       {"$EndElements is expected"}},  // gmsh would leave out the last cell
      {"$Elements\n6", "$Elements\n2000000000", {"2000000000 elements are promised"}},
      {"5 3 2 3 1 1 2 5 4", "5 3 2 3 1 1 2 9 4", {"element 5", "node 9"}},
      {"5 3 2 3 1 1 2 5 4", "5 3 2 3 -1 1 2 5 4", {"element 5", "-1"}},  // gmsh would leave it out
      {"5 3 2 3 1 1 2 5 4", "5 3 2000000000 3 1 1 2 5 4", {"labels are promised"}},
      {"5 3 2 3 1 1 2 5 4", "5 3 2 3 1 1 2 5.5 4", {"'5.5'"}},
  };
  for (const auto& [was, is, words] : ofVersion2)
    expectMessage(
        messageOf(test::writeFile("damaged2.msh", changed(test::quadranglesMsh2(), was, is))),
        words);
}

// gmsh's reader leaves a section at the first line that it does not understand, and the rest of the
// cells with it.
TEST(MeshFile, DamagedUnvIsToldByLine) {
  const std::string sound = test::quadranglesUnv();
  test::setOptions("-mesh_file " + test::writeFile("sound.unv", sound) + layer +
                   "-load_top_pressure 1");
  const auto mesh = test::readMesh();
  EXPECT_EQ(mesh.totalCells, 2);
  EXPECT_EQ(mesh.totalNodes, 6);
  const Damage damages[] = {
      {"         6        44", "         x        44", {"line 32", "'x' is not a number"}},
      {"         6        44", "         6       999", {"line 32", "element 6 is of type 999"}},
      {"         6        44", "         6        45", {"element 6 of type 45 has 8 nodes, not 4"}},
      {"         6        44", "         5        44", {"two elements with the tag 5"}},
      {"2         3         6         5",
       "2         3         9         5",
       {"line 33", "element 6 refers to node 9"}},
      {"2         3         6         5",
       "2         3         6",
       {"3 numbers where there should be 4"}},
      {"2.0000000000000000D+00", "nan", {"line 8", "finite"}},
      {"2.0000000000000000D+00", "2,0", {"line 8", "'2,0'"}},
      {"         3         1         1        11",
       "        -3         1         1        11",
       {"line 7", "node tag -3"}},
      {"bottom", " top ", {"two groups of the name 'top'"}},
  };
  for (const auto& [was, is, words] : damages)
    expectMessage(messageOf(test::writeFile("damaged.unv", changed(sound, was, is))), words);
  for (const std::size_t length : {sound.size() - 7, sound.size() / 2, sound.size() / 4})
    expectMessage(messageOf(test::writeFile("short.unv", sound.substr(0, length))), {"line"});
}

}  // namespace
}  // namespace squeal
