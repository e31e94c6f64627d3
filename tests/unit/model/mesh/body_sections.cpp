// SPDX-License-Identifier: BSD-2-Clause
// Sections of bodies in files that repeat a cell for each of its groups, and in files that do not.
#include <gtest/gtest.h>

#include "base/system/text.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/model/mesh_text.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using test::contains;

// A file of version 2 gives a cell another tag for each further group, one of version 4 the same.
TEST(Sections, GroupsOfFilesOfVersions2And4) {
  using test::changed;
  const std::string names = changed(test::quadranglesMsh2(), "$PhysicalNames\n3\n",
                                    "$PhysicalNames\n5\n2 4 \"a\"\n2 5 \"b\"\n");
  const std::string cells = "6 3 2 3 1 2 3 6 5\n";
  const auto elements = [&](int count, const std::string& more) {
    return changed(changed(names, "$Elements\n6\n", formatted("$Elements\n%d\n", count)), cells,
                   cells + more);
  };
  const auto message = [](const std::string& text, const std::string& options) {
    return test::messageOfMesh(test::writeFile("sections.msh", text), options);
  };
  const std::string layer = test::material("layer", "1", "0.3", "1"),
                    all = test::material("all", "1", "0.3", "1"),
                    both = "-material_layer_sections a,b ";
  const std::string sound = elements(8, "7 3 2 4 2 1 2 5 4\n8 3 2 5 3 2 3 6 5\n");
  EXPECT_EQ(message(sound, layer + both), "");
  EXPECT_EQ(message(sound, all + "-material_all_sections a,b"), "");
  EXPECT_TRUE(contains(message(elements(7, "7 3 2 4 2 1 2 5 4\n"), layer + both),
                       "names group 'b', which is not in the mesh"));
  EXPECT_TRUE(
      contains(message(elements(9, "7 3 2 4 2 1 2 5 4\n8 3 2 5 3 2 3 6 5\n9 3 2 5 3 1 2 5 4\n"),
                       layer + both),
               "is in the sections 'a' and 'b' of body 'layer'"));
  EXPECT_TRUE(
      contains(message(elements(9, "7 3 2 4 2 1 2 5 4\n8 3 2 5 3 2 3 6 5\n9 3 2 5 3 1 2 5 4\n"),
                       all + "-material_all_sections a,b"),
               "the cells 7 of group 'a' and 9 of group 'b' have the same nodes"));
  // Version 4: the surface is in three groups.
  const std::string four = changed(changed(test::quadranglesMsh4(), "$PhysicalNames\n3\n",
                                           "$PhysicalNames\n5\n2 4 \"a\"\n2 5 \"b\"\n"),
                                   "1 0 0 0 2 1 0 1 3 2 1 -2\n", "1 0 0 0 2 1 0 3 3 4 5 2 1 -2\n");
  EXPECT_EQ(message(four, layer + "-material_layer_sections a"), "");
  EXPECT_TRUE(contains(message(four, layer + both),
                       "cell 5 is in the sections 'a' and 'b' of body 'layer'"));
  EXPECT_TRUE(contains(message(four, all + "-material_all_sections a,b"),
                       "is in the sections 'a' and 'b' of body 'all'"));
}

}  // namespace
}  // namespace squeal
