// SPDX-License-Identifier: BSD-2-Clause
// The two sides of contact interfaces: their faces, and how meshes that do not match are marked.
#include <gtest/gtest.h>

#include <set>

#include "support/harness/bad_input.hpp"
#include "support/model/mesh_checks.hpp"
#include "support/model/mesh_text.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using mesh::Mesh;
using test::contains;
using test::total;

/// Parts of the mesh that have nodes on a surface, by name, on this rank.
std::set<std::string> partsOf(const Mesh& mesh, const std::string& surface) {
  std::set<std::string> names;
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e)
      if (mesh.surfaces.at(static_cast<std::size_t>(block.surface[e])) == surface)
        for (PetscInt node : block.nodesOf(e))
          names.insert(mesh.partName.at(static_cast<std::size_t>(mesh.nodePart[node])));
  return names;
}

// Nodes of its own or shared with the pad: the face of the disc has the disc's nodes, its normal
// points to the pad, and a load on it does not count it twice.
TEST(Interfaces, HaveTheFacesOfBothSides) {
  for (const std::string changes :
       {"", ",shared=1", ",order=2", ",order=2,shared=1", " -load_disc_face_pressure 1"}) {
    test::setCase("two_layers", "-mesh_set nx=6,ny_disc=3,ny_pad=2" + changes);
    const Mesh mesh = test::readMesh();
    SCOPED_TRACE(changes);
    const auto areas = test::areaVectors(mesh);
    for (const auto& [side, up] : std::map<std::string, double>{{"disc", 3}, {"pad", -3}}) {
      const auto& area = areas.at(side + "_face");
      EXPECT_NEAR(area[0], 0, 1e-12);
      EXPECT_NEAR(area[1], up, 1e-12);
      for (const auto& part : partsOf(mesh, side + "_face")) EXPECT_EQ(part, side);
    }
    ASSERT_EQ(mesh.interfaces.size(), 1u);
    EXPECT_TRUE(mesh.interfaces[0].matching);
    EXPECT_EQ(mesh.interfaces[0].mismatch, "");
  }
}

// A load on a face between two bodies could be meant for either.
TEST(Interfaces, SharedFaceOfTheDiscCannotBeLoaded) {
  test::setCase("two_layers",
                "-mesh_set nx=6,ny_disc=3,ny_pad=2,shared=1 -load_disc_face_pressure 1");
  const auto message = test::errorOf([] { test::readMesh(); });
  EXPECT_TRUE(contains(message, "'disc_face'") && contains(message, "it bounds 2")) << message;
}

// The group of the disc may have faces inside, as where a ring and its hat share nodes.
TEST(Interfaces, FacesInsideTheDiscAreLeftOut) {
  std::string text = test::quadranglesMsh2();
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("$Elements\n6\n", "$Elements\n7\n7 1 2 2 2 2 5\n");
  test::setOptions("-mesh_file " + test::writeFile("inner_face.msh", text) +
                   test::material("layer", "1", "0.3", "1") +
                   "-contact_face_pad bottom -contact_face_disc top");
  const Mesh mesh = test::readMesh();
  const auto area = test::areaVectors(mesh).at("top");
  EXPECT_EQ(area[0], 0);
  EXPECT_EQ(area[1], 2);
}

// Two bodies share three nodes, and the group of the pad has one of the two faces between: the
// bodies stay joined along the other, which is not a face of the disc.
TEST(Interfaces, JoinedFacesAreLeftOut) {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n1 1 \"pad_face\"\n1 2 "
      "\"disc_face\"\n"
      "2 3 \"disc\"\n2 4 \"pad\"\n$EndPhysicalNames\n"
      "$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n7 0 2 0\n8 1 2 0\n"
      "9 2 2 0\n$EndNodes\n"
      "$Elements\n7\n1 1 2 1 1 4 5\n2 1 2 2 2 4 5\n3 1 2 2 2 5 6\n4 3 2 3 3 1 2 5 4\n"
      "5 3 2 3 3 2 3 6 5\n6 3 2 4 4 4 5 8 7\n7 3 2 4 4 5 6 9 8\n$EndElements\n";
  test::setOptions("-mesh_file " + test::writeFile("joined.msh", text) +
                   test::material("disc", "1", "0.3", "1") +
                   test::material("pad", "1", "0.3", "1") + "-motion_disc_velocity 1,0,0 " +
                   "-contact_face_pad pad_face -contact_face_disc disc_face");
  const Mesh mesh = test::readMesh();
  EXPECT_EQ(mesh.totalNodes, 11);
  EXPECT_TRUE(mesh.interfaces.at(0).matching);
  const auto areas = test::areaVectors(mesh);
  EXPECT_EQ(areas.at("disc_face")[1], 1);
  EXPECT_EQ(areas.at("pad_face")[1], -1);
}

/// The mesh of two squares with so many cells along the face of each, on an interface between them
/// and on another one whose sides touch at a corner only.
Mesh squaresMesh(const std::string& disc, const std::string& pad) {
  const std::string file =
      test::writeFile("squares_" + disc + "_" + pad + ".geo", test::squares(disc, pad));
  test::setOptions("-mesh_file " + file + test::material("disc", "1", "0.3", "1") +
                   test::material("pad", "1", "0.3", "1") +
                   "-contact_face_pad pad_face -contact_face_disc disc_face "
                   "-contact_side_pad pad_left -contact_side_disc left");
  return test::readMesh();
}

TEST(Interfaces, MismatchIsMarkedAndLeavesNoPairs) {
  const Mesh alike = squaresMesh("4", "4");
  ASSERT_EQ(alike.interfaces.size(), 2u);
  EXPECT_EQ(alike.interfaces[0].label, "interface 'face'");
  EXPECT_TRUE(alike.interfaces[0].matching);
  EXPECT_FALSE(alike.interfaces[1].matching);
  EXPECT_EQ(alike.interfaces[0].mismatch, "");
  EXPECT_TRUE(
      contains(alike.interfaces[1].mismatch, "of 'pad_left' have no node of 'left' within "))
      << alike.interfaces[1].mismatch;
  EXPECT_EQ(total(static_cast<double>(alike.pairs.size())), 5);
  for (const auto& pair : alike.pairs) EXPECT_EQ(pair.interface, 0);

  // 1/5 is not a node of the four cells of the disc; the pad's nodes at 0, 1/2 and 1 are.
  const Mesh finer = squaresMesh("4", "5"), coarser = squaresMesh("4", "2");
  for (const Mesh* mesh : {&finer, &coarser}) {
    for (const auto& interface : mesh->interfaces) EXPECT_FALSE(interface.matching);
    EXPECT_EQ(total(static_cast<double>(mesh->pairs.size())), 0);
    const auto areas = test::areaVectors(*mesh);
    EXPECT_NEAR(areas.at("disc_face")[1], 1, 1e-12);
    EXPECT_NEAR(areas.at("pad_face")[1], -1, 1e-12);
  }
  EXPECT_TRUE(contains(finer.interfaces.at(0).mismatch,
                       "4 of 6 nodes of 'pad_face' have no node of 'disc_face'") &&
              contains(finer.interfaces.at(0).mismatch,
                       ", 0, 0), where no other body has one either: the two are not meshed alike"))
      << finer.interfaces.at(0).mismatch;
  for (const auto& interface : finer.interfaces)
    EXPECT_FALSE(interface.nearlyMatching);  // fewer than half have one
  EXPECT_EQ(coarser.interfaces.at(0).mismatch,
            "the face of 'pad_face' at (0, 0, 0) does not lie on one face of 'disc_face': is a "
            "face missing in this group?");
}

}  // namespace
}  // namespace squeal
