// SPDX-License-Identifier: BSD-2-Clause
// -mesh_straighten: where nodes go, who follows, and what is reported.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "model/elasticity/element.hpp"
#include "model/mesh/mesh.hpp"
#include "support/harness/folder_files.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/gmsh_library.hpp"
#include "support/model/mesh_checks.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Mesh;
using mesh::Point;

/// Two quadratic triangles on both sides of the edge from (0, 0) to (1, 0). The middle node of that
/// edge is at (0.5, 0.9), far inside the upper triangle, and that of the lower left edge at
/// (0.25, 0.5): with the first edge straight, it lies above it.
std::string nested() {
  constexpr std::array<std::array<double, 2>, 9> nodes{{{0, 0},
                                                        {1, 0},
                                                        {0.5, 1},
                                                        {0.5, -0.2},
                                                        {0.5, 0.9},
                                                        {0.75, 0.5},
                                                        {0.25, 0.5},
                                                        {0.25, 0.5},
                                                        {0.75, -0.1}}};
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 "
      "\"layer\"\n$EndPhysicalNames\n$Nodes\n9\n";
  for (std::size_t i = 0; i < nodes.size(); ++i)
    text += std::to_string(i + 1) + " " + std::to_string(nodes[i][0]) + " " +
            std::to_string(nodes[i][1]) + " 0\n";
  return text +
         "$EndNodes\n$Elements\n2\n1 9 2 1 1 1 2 3 5 6 7\n2 9 2 1 1 2 1 4 5 8 9\n$EndElements\n";
}

/// Collective. Reads the mesh with this value of the option.
Mesh readStraightened(const std::string& file, const std::string& which) {
  test::setOptions("-mesh_file " + file + " -mesh_straighten " + which +
                   test::material("layer", "1", "0.3", "1"));
  return test::readMesh();
}

/// Collective. The number of folded cells.
double foldedCells(const Mesh& mesh) {
  double count = 0;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      std::vector<Point> points;
      for (PetscInt node : block.nodesOf(e)) points.push_back(mesh.coordinates[node]);
      count += elasticity::foldedAnywhere(block.type, points);
    }
  return test::total(count);
}

/// Collective. The place of the node with this tag.
Point placeOf(const Mesh& mesh, PetscInt tag) {
  Point place{};
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (mesh.nodeTag[node] == tag) place = mesh.coordinates[node];
  for (auto& x : place) x = test::total(x);
  return place;
}

// The straight first edge folds the lower triangle, which another round straightens.
TEST(Straighten, GoesOnUntilNoCellIsFolded) {
  const auto file = test::writeFile("nested.msh", nested());
  const Mesh as = readStraightened(file, "none");
  EXPECT_EQ(foldedCells(as), 1);
  EXPECT_EQ(as.straightened.nodes, 0);
  const Mesh mesh = readStraightened(file, "bad");
  EXPECT_EQ(foldedCells(mesh), 0);
  EXPECT_EQ(mesh.straightened.rounds, 2);
  EXPECT_EQ(mesh.straightened.folded, 2);
  EXPECT_EQ(mesh.straightened.cells, 2);
  EXPECT_EQ(mesh.straightened.nodes, 2);
  EXPECT_NEAR(mesh.straightened.largestMove, 0.9, 1e-15);  // from (0.5, 0.9) to (0.5, 0)
  const Point first = placeOf(mesh, 5), second = placeOf(mesh, 8);
  EXPECT_NEAR(first[0], 0.5, 1e-15);
  EXPECT_NEAR(first[1], 0, 1e-15);
  EXPECT_NEAR(second[0], 0.25, 1e-15);
  EXPECT_NEAR(second[1], -0.1, 1e-15);
}

/// The two layers of quadratic triangles or quadrangles with the middle nodes of two edges bent:
/// on the contact at x = 0.5 into the pad, and on the sides of the pad at x = 0 and 3 to the right.
/// Of both, the pad and the disc, or the two sides, have a node.
std::string bentLayers(const std::string& name, bool recombine) {
  const std::string file = SQUEAL_OUTPUT_DIR "/" + name;
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) {
    test::startGmsh();
    gmsh::clear();
    gmsh::onelab::clear();
    for (const auto& [parameter, value] :
         {std::pair{"nx", 3.0}, {"ny_disc", 1.0}, {"ny_pad", 1.0}, {"order", 2.0}})
      gmsh::onelab::setNumber(parameter, {value});
    gmsh::onelab::setNumber("recombine", {recombine ? 1.0 : 0.0});
    gmsh::open("meshes/two_layers.geo");
    gmsh::model::mesh::generate(2);
    std::vector<std::size_t> tags;
    std::vector<double> x, parametric;
    gmsh::model::mesh::getNodes(tags, x, parametric);
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-6; };
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const bool contact = near(x[3 * i], 0.5) && near(x[3 * i + 1], 0),
                 side = (near(x[3 * i], 0) || near(x[3 * i], 3)) && near(x[3 * i + 1], 0.3);
      if (contact) gmsh::model::mesh::setNode(tags[i], {x[3 * i], 0.5, 0}, {});
      if (side) gmsh::model::mesh::setNode(tags[i], {x[3 * i] + 0.9, 0.3, 0}, {});
    }
    gmsh::option::setNumber("Mesh.MshFileVersion", 2.2);
    gmsh::option::setNumber("Mesh.Binary", 0);
    gmsh::write(file);
    gmsh::clear();
  }
  check(MPI_Barrier(PETSC_COMM_WORLD));
  return file;
}

const char* const layerOptions =
    " -motion_disc_velocity 1,0,0 -constraint_disc_bottom_clamped xy -constraint_pad_top_clamped "
    "xy "
    "-constraint_disc_right_image_of disc_left -constraint_pad_right_image_of pad_left "
    "-contact_interface_pad pad_face -contact_interface_disc disc_face ";

// A folded cell of the pad takes the node of the disc under it along, and one on a periodic side
// its image.
TEST(Straighten, MovesPartnersAndImagesAlike) {
  for (const bool recombine : {false, true}) {
    const auto file = bentLayers("bent.msh", recombine);
    const auto read = [&](const std::string& which) {
      test::setOptions("-mesh_file " + file + " -mesh_straighten " + which + layerOptions +
                       test::material("disc", "1", "0.3", "1") +
                       test::material("pad", "1", "0.3", "1"));
      return test::readMesh();
    };
    EXPECT_GE(foldedCells(read("none")), 1) << recombine;
    for (const std::string which : {"bad", "all"}) {
      const Mesh mesh = read(which);
      EXPECT_EQ(foldedCells(mesh), 0) << which << recombine;
      EXPECT_EQ(mesh.straightened.nodes, 4) << which << recombine;
      EXPECT_NEAR(mesh.straightened.largestMove, 0.9, 1e-9) << which << recombine;
      const auto places = test::allCoordinates(mesh);
      EXPECT_EQ(test::total(static_cast<double>(mesh.pairs.size())), 6);
      for (const auto& pair : mesh.pairs)
        for (std::size_t d = 0; d < 3; ++d) {
          EXPECT_NEAR(mesh.coordinates[pair.node][d],
                      places[3 * static_cast<std::size_t>(pair.master) + d], 1e-9);
        }
      for (const auto& pair : mesh.pairs) EXPECT_NEAR(mesh.coordinates[pair.node][1], 0, 1e-9);
      for (const auto& image : mesh.images)
        for (std::size_t d = 0; d < 3; ++d)
          EXPECT_NEAR(mesh.coordinates[image.node][d] - image.shift[d],
                      places[3 * static_cast<std::size_t>(image.primary) + d], 1e-14);
      for (PetscInt node = 0; node < mesh.ownedNodes; ++node)  // no node but on its straight edge
        EXPECT_NEAR(std::remainder(mesh.coordinates[node][0], 0.5), 0, 1e-9) << which << recombine;
    }
  }
}

// What has the corners in the wrong order is as it was, and the error says that nothing helps.
TEST(Straighten, LeavesCornersAlone) {
  auto text = nested();
  text.replace(text.find("1 2 3 5 6 7"), 11, "2 1 3 5 7 6");
  const Mesh mesh = readStraightened(test::writeFile("turned.msh", text), "bad");
  EXPECT_EQ(foldedCells(mesh), 1);
  const auto message = test::errorOf([&] { test::assembleBodies(mesh); });
  EXPECT_TRUE(test::contains(message,
                             "from only the corners, it is still not positive in 1 of these cells"))
      << message;
  EXPECT_FALSE(test::contains(message, "-mesh_straighten bad")) << message;
}

// Straight cells of a file are left as they are, to the last bit.
TEST(Straighten, MovesNothingThatIsStraight) {
  test::setOptions("-mesh_file meshes/beam.geo -mesh_set nx=4,order=2,recombine=0 " +
                   test::material("beam", "1", "0.3", "1"));
  const auto before = test::allCoordinates(test::readMesh());
  insert(settingsOfText("-mesh_straighten all"));
  const Mesh mesh = test::readMesh();
  EXPECT_EQ(mesh.straightened.nodes, 0);
  EXPECT_EQ(test::allCoordinates(mesh), before);
}

// The nodes with straight edges are those of the linear cell: a linear field of places is kept.
TEST(Straighten, KeepsWhatIsStraightOnEveryElement) {
  test::startGmsh();
  for (int type : {9, 10, 11, 12, 13, 14, 16, 17, 18, 19}) {
    const auto& table = element::shapeTable(type);
    std::string name;
    int dimension = 0, order = 0, nodes = 0, corners = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, local, corners);
    ASSERT_EQ(nodes, table.nodes);
    std::vector<Point> straight;
    for (int i = 0; i < nodes; ++i) {
      const auto u = [&](int d) { return d < dimension ? local[i * dimension + d] : 0.0; };
      straight.push_back({1 + 2 * u(0) + 0.3 * u(1) - 0.1 * u(2),
                          0.2 * u(0) + 3 * u(1) + 0.4 * u(2),
                          0.1 * u(0) - 0.5 * u(1) + 1.5 * u(2)});
    }
    auto bent = straight;
    for (int i = corners; i < nodes; ++i) bent[i][i % 3] += 0.1 * i;
    const auto result = elasticity::straightened(type, bent);
    for (int i = 0; i < nodes; ++i)
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_NEAR(result[i][d], straight[i][d], 1e-14) << table.name << " node " << i;
  }
}

}  // namespace
}  // namespace squeal
