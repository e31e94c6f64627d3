// SPDX-License-Identifier: BSD-2-Clause
// Groups of mesh files: their names, their cells, and surfaces of several groups.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "support/harness/messages.hpp"
#include "support/model/layer_file.hpp"
#include "support/model/mesh_checks.hpp"
#include "support/model/mesh_text.hpp"

namespace squeal::test {
namespace {

namespace fs = std::filesystem;

// Version 2 repeats a cell for each of its groups.
TEST(MeshFile, GroupsOfVersion2MayOverlap) {
  auto text =
      changed(quadranglesMsh2(), "$PhysicalNames\n3\n", "$PhysicalNames\n4\n2 4 \"right\"\n");
  text = changed(changed(text, "$Elements\n6", "$Elements\n7"), "$EndElements",
                 "7 3 2 4 1 2 3 6 5\n$EndElements");
  const auto file = writeFile("overlap.msh", text);
  setOptions("-mesh_file " + file + layer);
  EXPECT_EQ(readMesh().totalCells, 2);
  expectMessage(messageOf(file, layer + material("right", "1", "0.3", "1")),
                {"cells 6 of group 'layer' and 7 of group 'right' have the same nodes"});
  expectMessage(messageOf(file, material("right", "1", "0.3", "1")),
                {"group 'layer' has no material", "(cell 5)"});
}

// gmsh knows the sections 2435, 2452 and 2477 of groups; Salome writes 2467, of the same records.
// Of a name gmsh reads the first word.
TEST(MeshFile, GroupsOfUnvHaveTheirWholeNames) {
  int ranks = 1;
  check(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  const fs::path folder = SQUEAL_OUTPUT_DIR "/copies_" + std::to_string(ranks);
  fs::create_directories(folder);
  setenv("TMPDIR", folder.c_str(), 1);
  for (const char* section : {"2435", "2452", "2467", "2477"}) {
    auto text = changed(quadranglesUnv(), "  2477\n", std::string("  ") + section + "\n");
    text = changed(changed(text, "\nbottom\n", "\nface of it\n"), "\ntop\n", "\nface  above\r\n");
    const auto file = writeFile("names.unv", text);
    setOptions("-mesh_file " + file + layer +
               "-load_face_of_it_pressure 1 -load_face_above_pressure 1");
    const auto mesh = readMesh();
    EXPECT_EQ(mesh.totalCells, 2) << section;
    const auto areas = areaVectors(mesh);
    EXPECT_NEAR(areas.at("face_of_it")[1], -2, 1e-14) << section;
    EXPECT_NEAR(areas.at("face_above")[1], 2, 1e-14) << section;
    expectMessage(messageOf(file, layer + "-load_face_pressure 1"),
                  {"its groups are: face_above, face_of_it, layer"});
  }
  EXPECT_TRUE(fs::is_empty(folder));  // the copies are gone
  unsetenv("TMPDIR");
}

// gmsh puts the elements of one entity into all groups of that entity; many programs write 1 for
// every entity.
TEST(MeshFile, EachElementOfVersion2IsInTheGroupThatItNames) {
  std::string text = changed(quadranglesMsh2(), "3 1 2 2 2 4 5", "3 1 2 2 1 4 5");
  text = changed(text, "4 1 2 2 2 5 6", "4 1 2 2 1 5 6");
  setOptions("-mesh_file " + writeFile("one_entity.msh", text) + layer +
             "-constraint_bottom_clamped xy");
  const auto mesh = readMesh();
  EXPECT_EQ(total(static_cast<double>(mesh.nodeGroups.at("bottom").size())),
            3);  // not all six
}

// A surface with two names, as a shared contact surface has, is written twice in version 2.
TEST(MeshFile, ASurfaceWithTwoNamesIsNotDoubled) {
  const std::string file = SQUEAL_OUTPUT_DIR "/two_names.msh";
  if (rankOf() == 0) {
    std::string text = changed(quadranglesMsh2(), "$Elements\n6", "$Elements\n8");
    text = changed(text, "$EndElements", "7 1 2 4 2 4 5\n8 1 2 4 2 5 6\n$EndElements");
    std::ofstream(file) << changed(changed(text, "$PhysicalNames\n3", "$PhysicalNames\n4"),
                                   "2 3 \"layer\"", "1 4 \"roof\"\n2 3 \"layer\"");
  }
  check(MPI_Barrier(PETSC_COMM_WORLD));
  for (const std::string surface : {"top", "roof"}) {
    setOptions("-mesh_file " + file + layer + "-load_" + surface + "_pressure 1");
    const auto mesh = readMesh();
    const auto bodies = assembleBodies(mesh);
    EXPECT_NEAR(dot(nodalField(mesh,
                               [](const mesh::Point&) {
                                 return mesh::Point{0, 1, 0};
                               }),
                    bodies.load),
                -2, 1e-14)
        << surface;  // 1 Pa on 2 m
  }
}

TEST(MeshFile, GroupNamesWithBlanksHaveUnderscoresInOptions) {
  const auto file =
      writeFile("blanks.msh", changed(quadranglesMsh2(), "\"layer\"", "\"brake  disc\""));
  EXPECT_EQ(messageOf(file, material("brake__disc", "1", "0.3", "1")), "");
  expectMessage(messageOf(file, material("disc", "1", "0.3", "1")),
                {"'disc'", "its groups are: bottom, brake__disc, top"});
  const auto both =
      writeFile("blanks2.msh",
                changed(changed(quadranglesMsh2(), "\"bottom\"", "\"a b\""), "\"top\"", "\"a_b\""));
  expectMessage(messageOf(both), {"'a b'", "'a_b'", "underscores stand for blanks"});
}

TEST(MeshFile, AMeshWithoutGroupsSaysSo) {
  const auto file =
      writeFile("nameless.geo", "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1};\n");
  expectMessage(messageOf(file), {"'layer'", "it has no physical groups at all"});
}

}  // namespace
}  // namespace squeal::test
