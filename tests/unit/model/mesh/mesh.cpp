// SPDX-License-Identifier: BSD-2-Clause
// The distributed mesh: numbering, groups, pairs, images and partition, whatever the number of
// ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "model/mesh/mesh.hpp"
#include "model/mesh/pairing.hpp"
#include "model/mesh/partition.hpp"
#include "model/mesh/whole.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/mesh_checks.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Mesh;
using mesh::Point;
using test::allCoordinates;
using test::areaVectors;
using test::expectCells;
using test::expectNumbering;
using test::groupSize;

// A box of nx × ny × nz cells: all counts are known, so they cannot depend on the number of ranks.
TEST(Mesh, CountsAndNumbersOfABox) {
  for (const int order : {1, 2}) {
    test::setOptions(
        "-mesh_file meshes/beam.geo -mesh_set Lx=1,Ly=0.4,Lz=0.2,nx=8,ny=3,nz=2,order=" +
        std::to_string(order) + test::material("beam", "1", "0.3", "1") +
        "-constraint_clamped_clamped xyz -load_top_pressure 1 -load_bottom_pressure 1 "
        "-load_left_pressure 1 -load_tip_pressure 1");
    const Mesh mesh = test::readMesh();
    EXPECT_EQ(mesh.dimension, 3);
    EXPECT_EQ(mesh.totalCells, 48);
    EXPECT_EQ(mesh.totalNodes, (8 * order + 1) * (3 * order + 1) * (2 * order + 1));
    EXPECT_EQ(groupSize(mesh, "clamped"), (3 * order + 1) * (2 * order + 1));
    for (PetscInt node : mesh.nodeGroups.at("clamped")) {
      ASSERT_TRUE(node >= 0 && node < mesh.ownedNodes);
      EXPECT_NEAR(mesh.coordinates[node][0], 0, 1e-12);
    }
    EXPECT_EQ(mesh.parts, 1);
    EXPECT_EQ(mesh.partName, (std::vector<std::string>{"beam"}));
    EXPECT_TRUE(mesh.images.empty() && mesh.pairs.empty());
    expectNumbering(mesh);
    expectCells(mesh);
    const std::map<std::string, Point> expected{{"top", {0, 0, 0.4}},
                                                {"bottom", {0, 0, -0.4}},
                                                {"left", {0, 0.2, 0}},
                                                {"tip", {0.08, 0, 0}}};
    const auto areas = areaVectors(mesh);
    ASSERT_EQ(areas.size(), expected.size());
    for (const auto& [surface, area] : expected)
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_NEAR(areas.at(surface)[d], area[d], 1e-13) << surface;
  }
}

/// Positions of all contact pairs, sorted; what every pair must fulfil is checked on the way.
std::vector<std::pair<double, double>> contactPositions(const Mesh& mesh) {
  const auto coordinates = allCoordinates(mesh);
  const int disc = static_cast<int>(std::find(mesh.bodies.begin(), mesh.bodies.end(), "disc") -
                                    mesh.bodies.begin());
  std::vector<double> mine;
  for (const auto& pair : mesh.pairs) {
    EXPECT_LT(pair.node, mesh.ownedNodes);
    const auto& x = mesh.coordinates[pair.node];
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(x[d], coordinates[3 * static_cast<std::size_t>(pair.master) + d], 1e-9);
    EXPECT_NE(pair.master, mesh.firstNode + pair.node);
    EXPECT_EQ(pair.masterBody, disc);
    EXPECT_EQ(mesh.partName[pair.masterPart], "disc");
    EXPECT_EQ(mesh.partName[mesh.nodePart[pair.node]], "pad");
    mine.insert(mine.end(), {x[0], x[1]});
  }
  const auto all = test::gathered(mine, MPI_DOUBLE);
  std::vector<std::pair<double, double>> positions;
  for (std::size_t i = 0; i < all.size(); i += 2) positions.emplace_back(all[i], all[i + 1]);
  std::sort(positions.begin(), positions.end());
  return positions;
}

// Nodes that both layers own are split: then they are what coincident nodes are.
TEST(Mesh, SharedAndCoincidentInterfaceNodesGiveTheSamePairs) {
  for (const std::string shape : {"", ",order=2", ",order=2,serendipity=1", ",recombine=0"}) {
    std::vector<std::vector<std::pair<double, double>>> positions;
    std::vector<PetscInt> nodes;
    for (const std::string shared : {"0", "1"}) {
      test::setCase("two_layers", "-mesh_set nx=6,ny_disc=3,ny_pad=2,shared=" + shared + shape);
      const Mesh mesh = test::readMesh();
      expectNumbering(mesh);
      expectCells(mesh);
      EXPECT_EQ(mesh.parts, 2);
      positions.push_back(contactPositions(mesh));
      nodes.push_back(mesh.totalNodes);
      // After the split no cell of one body has a node of the other.
      for (const auto& block : mesh.cells)
        for (std::size_t i = 0; i < block.nodes.size(); ++i)
          EXPECT_EQ(mesh.partName[mesh.nodePart[block.nodes[i]]],
                    mesh.bodies[block.body[i / static_cast<std::size_t>(block.nodesPerCell)]]);
      // Towards the disc, whichever cells the interface's lines were drawn with.
      const auto area = areaVectors(mesh).at("pad_face");
      EXPECT_NEAR(area[0], 0, 1e-12);
      EXPECT_NEAR(area[1], -3, 1e-12);
    }
    EXPECT_EQ(nodes[0], nodes[1]) << shape;
    ASSERT_EQ(positions[0].size(), shape.find("order=2") == std::string::npos ? 6u : 12u)
        << shape;  // the end at x = 3 is an image
    for (std::size_t i = 0; i < positions[0].size(); ++i) {
      EXPECT_NEAR(positions[0][i].first, positions[1][i].first, 1e-9);
      EXPECT_NEAR(positions[0][i].first,
                  3.0 * static_cast<double>(i) / static_cast<double>(positions[0].size()), 1e-9);
    }
  }
}

TEST(Mesh, SharedNodesNeedOneMovingBody) {
  test::setCase("two_layers",
                "-mesh_set nx=6,ny_disc=3,ny_pad=2,shared=1 -motion_pad_velocity 1,0,0");
  const auto message = test::errorOf([] { test::readMesh(); });
  EXPECT_TRUE(test::contains(message, "-contact_interface_pad")) << message;
  EXPECT_TRUE(test::contains(message, "-motion_")) << message;
}

TEST(Mesh, PeriodicImagesAreTranslates) {
  test::setCase("layer", "-mesh_set nx=5,ny=4");
  const Mesh mesh = test::readMesh();
  const auto coordinates = allCoordinates(mesh);
  EXPECT_EQ(test::total(static_cast<double>(mesh.images.size())), 5);
  for (const auto& image : mesh.images) {
    EXPECT_LT(image.node, mesh.ownedNodes);
    EXPECT_EQ(image.primaryPart, 0);
    const auto& x = mesh.coordinates[image.node];
    EXPECT_NEAR(x[0], 3, 1e-12);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(image.shift[d], d == 0 ? 3 : 0,
                  1e-9);  // gmsh places nodes on a line to 11 digits
      EXPECT_NEAR(coordinates[3 * static_cast<std::size_t>(image.primary) + d],
                  x[d] - image.shift[d], 1e-14);
    }
  }
  // Groups hold primaries: the clamped corner (3, −1) is that at (0, −1); the face under the plate
  // has one node less than it shows.
  EXPECT_EQ(groupSize(mesh, "bottom"), 5);
  EXPECT_EQ(test::total(static_cast<double>(mesh.pairs.size())), 5);
}

// Periodic in x and z: nodes of the edge are images of images, all of one primary.
TEST(Mesh, ImagesOfImagesEndAtOnePrimary) {
  test::setOptions("-mesh_file meshes/layer_slab.geo -mesh_set nx=4,ny=2,nz=3,depth=0.5" +
                   test::material("layer", "1", "0.3", "1") +
                   "-constraint_right_image_of left -constraint_front_image_of back "
                   "-constraint_bottom_clamped xyz");
  const Mesh mesh = test::readMesh();
  expectNumbering(mesh);
  const auto coordinates = allCoordinates(mesh);
  // 5 × 3 × 4 nodes; primaries are those with x < 3 and z < depth.
  EXPECT_EQ(mesh.totalNodes, 60);
  EXPECT_EQ(test::total(static_cast<double>(mesh.images.size())), 60 - 4 * 3 * 3);
  EXPECT_EQ(groupSize(mesh, "bottom"), 4 * 3);
  for (const auto& image : mesh.images) {
    const double* primary = &coordinates[3 * static_cast<std::size_t>(image.primary)];
    const auto& x = mesh.coordinates[image.node];
    EXPECT_NEAR(primary[0], x[0] > 2.9 ? x[0] - 3 : x[0], 1e-9);
    EXPECT_NEAR(primary[1], x[1], 1e-9);
    EXPECT_NEAR(primary[2], x[2] > 0.49 ? x[2] - 0.5 : x[2], 1e-9);
  }
}

// The whole mesh as rank 0 sees it, cut for more ranks than the test has.
TEST(Partition, NoRankIsEmpty) {
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  test::setCase("two_layers", "-mesh_set nx=12,ny_disc=4,ny_pad=3");
  const auto settings = analysis::ModelSettings::given();
  const auto request = analysis::meshRequest(settings);
  std::string failure;
  if (rank == 0) {
    auto whole = mesh::load(settings.file, request, test::readInCopy);
    mesh::pairNodes(whole, request);
    for (const int parts : {1, 2, 3, 4, 7, 16}) {
      const auto rankOfCell = mesh::partition(whole, parts);
      ASSERT_EQ(rankOfCell.size(), 84u);
      std::vector<int> cells(static_cast<std::size_t>(parts), 0);
      for (int part : rankOfCell) ++cells.at(static_cast<std::size_t>(part));
      EXPECT_GT(*std::min_element(cells.begin(), cells.end()), 0) << parts << " parts";
      EXPECT_LE(*std::max_element(cells.begin(), cells.end()), std::ceil(1.2 * 84 / parts))
          << parts << " parts";
    }
    failure = test::errorOf([&] { mesh::partition(whole, 85); });
    EXPECT_TRUE(test::contains(failure, "84 cells")) << failure;
  }
}

// METIS may leave a rank without cells on a handful of them (harmless, but idle); from four a rank
// on it must not.
TEST(Partition, NoRankIsEmptyOnAFewCells) {
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank != 0) return;
  const std::tuple<const char*, std::vector<std::string>, const char*> meshes[] = {
      {"meshes/patch_3d.geo", {"n=1"}, "body"},                 // 8 cells
      {"meshes/patch_2d.geo", {"n=2", "recombine=0"}, "body"},  // 32
      {"meshes/layer.geo", {"nx=11", "ny=1"}, "layer"},         // a row
      {"meshes/layer.geo", {"nx=5", "ny=5"}, "layer"},
  };
  for (const auto& [file, set, body] : meshes) {
    mesh::Request request;
    request.bodies = {{body, "the test"}};
    auto whole = mesh::load(
        {.file = file, .parameters = meshfile::parametersOf(set), .shape = {}, .scale = 1}, request,
        test::readInCopy);
    mesh::pairNodes(whole, request);
    for (int parts = 2; parts <= whole.cellCount() / 4; ++parts) {
      const auto rankOfCell = mesh::partition(whole, parts);
      EXPECT_EQ(std::set<int>(rankOfCell.begin(), rankOfCell.end()).size(),
                static_cast<std::size_t>(parts))
          << file << " " << set[0];
    }
  }
}

struct Wrong {
  const char *change, *words[3];
};

// Each mistake is reported on all ranks, with the names that help.
TEST(Mesh, ErrorsNameGroupAndOption) {
  const Wrong mistakes[] = {
      {"-mesh_file meshes/nowhere.geo", {"-mesh_file meshes/nowhere.geo", "no such file", ""}},
      {"-mesh_set nx", {"-mesh_set nx", "name=number", ""}},
      {"-constraint_botom_clamped xy", {"'botom'", "groups are", "disc_bottom"}},
      {"-load_sky_pressure 1", {"-load_sky_pressure", "'sky'", "pad_top"}},
      {"-material_ring_young 1 -material_ring_poisson 0 -material_ring_density 1",
       {"-material_ring_young", "'ring'", "disc"}},
      {"-constraint_pad_top_image_of disc_left",
       {"-constraint_pad_top_image_of", "no partner", "translate"}},
      {"-load_disc_pressure 1", {"-load_disc_pressure", "dimension", "'disc'"}},
  };
  for (const auto& mistake : mistakes) {
    test::setCase("two_layers", std::string("-mesh_set nx=6,ny_disc=3,ny_pad=2 ") + mistake.change);
    const auto message = test::errorOf([] { test::readMesh(); });
    EXPECT_NE(message, "") << mistake.change;
    for (const char* word : mistake.words)
      EXPECT_TRUE(test::contains(message, word)) << mistake.change << ": " << message;
  }
  test::setOptions("-mesh_file meshes/two_layers.geo -mesh_set nx=6,ny_disc=3,ny_pad=2" +
                   test::material("disc", "1", "0.3", "1"));
  const auto message = test::errorOf([] { test::readMesh(); });
  EXPECT_TRUE(test::contains(message, "'pad' has no material")) << message;
}

}  // namespace
}  // namespace squeal
