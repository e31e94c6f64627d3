// SPDX-License-Identifier: BSD-2-Clause
// Nodes of ties that are moved onto their masters.
#include "model/ties/ties.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "model/mesh/vector.hpp"
#include "support/harness/messages.hpp"
#include "support/model/blocks_apart.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using interfaces::Interfaces;
using mesh::Point;
using test::Block;

constexpr int quad4 = 3, quad9 = 10, quad8 = 16;
constexpr double gap = 0.02;
const std::string tie = "-tie_low_slave pad_low -tie_low_master disc_high ";

struct Case {
  mesh::Mesh file, mesh;  ///< before and after nodes were moved
  Interfaces ties;
};

/// Collective on the communicator.
Case caseOf(const std::string& options, MPI_Comm comm = PETSC_COMM_WORLD) {
  test::setOptions(options);
  mesh::Mesh mesh = test::readMesh(comm);
  const mesh::Mesh file = mesh;
  Interfaces ties = test::findTies(mesh);
  return {file, std::move(mesh), std::move(ties)};
}

/// Collective. Returns the coordinates of all nodes, [global node].
std::vector<Point> placesOf(const mesh::Mesh& mesh) {
  std::vector<Point> places(mesh.totalNodes, Point{});
  for (PetscInt i = 0; i < mesh.ownedNodes; ++i) places[mesh.globalNode[i]] = mesh.coordinates[i];
  check(MPI_Allreduce(MPI_IN_PLACE, places.data(), 3 * mesh.totalNodes, MPI_DOUBLE, MPI_SUM,
                      mesh.comm));
  return places;
}

double distance(const Point& a, const Point& b) { return mesh::length(mesh::minus(a, b)); }

/// Collective. Returns the largest |x_i − Σ P_il x_l| of the tied nodes.
double farthest(const Case& c) {
  const auto places = placesOf(c.mesh);
  double worst = 0;
  for (const auto& node : c.ties.tied) {
    Point sum{};
    for (const auto& [l, weight] : node.connection.masters)
      for (std::size_t d = 0; d < 3; ++d) sum[d] += weight * places[l][d];
    worst = std::max(worst, distance(sum, c.mesh.coordinates[node.connection.node]));
  }
  return test::largest(worst);
}

/// Collective. Returns the largest difference of the coordinates of ghosts from their owners'.
double ghostsOff(const mesh::Mesh& mesh) {
  const auto places = placesOf(mesh);
  double worst = 0;
  for (PetscInt i = 0; i < mesh.localNodes(); ++i)
    worst = std::max(worst, distance(mesh.coordinates[i], places[mesh.globalNode[i]]));
  return test::largest(worst);
}

/// Options of a disc below y = 0 and a pad that is some way above it.
std::string layers(const std::string& file, int cell, int discCells, int padCells,
                   const Block& pad) {
  return test::blocksApart(file, {cell, {discCells, 1, 2}, {0, 0, -1}, {1, 1, 0}, 0},
                           {cell, {padCells, 1, pad.cells[2]}, pad.low, pad.high, 0});
}

/// The same with the tie in place of the contact.
std::string tied(std::string options) { return options.substr(0, options.find("-contact_")) + tie; }

// A pad above the disc comes down on it, and reaches beyond it: the nodes there are not tied, and
// stay. Those within edges and cells follow the corners.
TEST(Ties, TiedNodesAreMovedAndOthersAreNot) {
  for (const int cell : {quad4, quad8, quad9}) {
    const std::string options =
        tied(layers("ties_above.msh", cell, 6, 8, {cell, {0, 0, 1}, {0.25, 0, gap}, {2.25, 0, 1}}));
    const Case c = caseOf(options);
    EXPECT_LT(farthest(c), 1e-14);
    EXPECT_LT(ghostsOff(c.mesh), 1e-15);
    const auto& report = c.ties.reports.at(0);
    EXPECT_NEAR(report.largestAdjustment, gap, 1e-12);
    EXPECT_NEAR(report.coveredArea, 0.75, 1e-12);  // three cells of eight
    EXPECT_NEAR(report.slave.area, 2, 1e-12);
    EXPECT_EQ(report.nodes, cell == quad4 ? 4 : 7);
    EXPECT_EQ(report.untied, cell == quad4 ? 5 : 10);
    for (PetscInt i = 0; i < c.mesh.localNodes(); ++i) {
      const Point &x = c.mesh.coordinates[i], &before = c.file.coordinates[i];
      if (before[1] < gap - 1e-9) continue;
      const bool low = before[1]<gap + 1e-9, high = before[1]> 1 - 1e-9,
                 above = before[0] < 1 + 1e-9, atCorner = before[0] < 1.25 - 1e-9;
      const double down = high  ? 0
                          : low ? (above ? gap : 0)
                          // mid-edge nodes half way up; that of the first cell beyond is between
                          // a corner that has moved and one that has not
                          : above    ? gap / 2
                          : atCorner ? gap / 4
                                     : 0;
      EXPECT_NEAR(x[0], before[0], 1e-12);
      EXPECT_NEAR(x[1], before[1] - down, 1e-12) << before[0] << " " << before[1];
    }
    const Case off = caseOf(options + "-tie_low_adjust off");
    EXPECT_EQ(off.mesh.coordinates, off.file.coordinates);
    EXPECT_EQ(off.ties.reports.at(0).largestAdjustment, 0);
    EXPECT_EQ(off.ties.tied.size(), c.ties.tied.size());
  }
}

// Nodes of which the program says that they are at one place are put there.
TEST(Ties, PairsOfNodesAreMovedTogether) {
  const std::string options =
      tied(layers("ties_pairs.msh", quad8, 6, 6, {quad8, {0, 0, 1}, {0, 0, 1e-7}, {1, 0, 1}}));
  const Case c = caseOf(options);
  EXPECT_TRUE(c.ties.reports.at(0).matching);
  EXPECT_NEAR(c.ties.reports.at(0).largestAdjustment, 1e-7, 1e-12);
  EXPECT_NEAR(c.ties.reports.at(0).coveredArea, 1, 1e-6);
  EXPECT_EQ(c.ties.reports.at(0).nodes, 13);
  EXPECT_EQ(c.ties.reports.at(0).untied, 0);
  EXPECT_LT(farthest(c), 1e-16);
  EXPECT_GT(farthest(caseOf(options + "-tie_low_adjust off")), 0.9e-7);
}

// Where masters have periodic images, what counts is where these are: along the surface nodes do
// not move. Images follow their primaries.
TEST(Ties, ImagesMoveWithTheirPrimaries) {
  for (const double shift : {0.0, 0.3}) {
    const Case c =
        caseOf(tied(layers("ties_images.msh", quad9, 6, 8,
                           {quad9, {0, 0, 1}, {shift, 0, gap}, {1 + shift, 0, 1}})) +
               "-constraint_disc_x1_image_of disc_x0 -constraint_pad_x1_image_of pad_x0 ");
    double off = 0, on = 0;
    for (PetscInt i = 0; i < c.mesh.localNodes(); ++i) {
      const Point &x = c.mesh.coordinates[i], &before = c.file.coordinates[i];
      off = std::max(off, std::abs(x[0] - before[0]));
      if (std::abs(before[1] - gap) < 1e-9) on = std::max(on, std::abs(x[1]));
    }
    EXPECT_LT(test::largest(off), 1e-13);
    EXPECT_LT(test::largest(on), 1e-13);
    EXPECT_EQ(c.ties.reports.at(0).untied, 0);
  }
}

/// Two pads on a disc, beside each other and above it. Of the second one, the nodes at the bottom
/// rest on the disc and on the corner that belongs to its side; that corner rests on the first
/// pad's, and this on the disc.
std::string chain(const std::string& file) {
  test::BlockWriter writer;
  writer.add("disc", {quad9, {7, 1, 2}, {0, 0, -1}, {2, 1, 0}, 0});
  writer.add("pad", {quad9, {4, 1, 2}, {0, 0, gap}, {1, 1, 1}, 0});
  writer.add("side", {quad9, {3, 1, 3}, {1.01, 0, gap / 2}, {2, 1, 1}, 0});
  std::string options = "-mesh_file " + test::writeFile(file, writer.text());
  for (const std::string body : {"disc", "pad", "side"})
    options += test::material(body, "1", "0.3", "1");
  return options + "-tie_between_slave side_x0 -tie_between_master pad_x1 " + tie +
         "-tie_side_slave side_low -tie_side_master disc_high ";
}

TEST(Ties, ChainsMoveTheMastersFirst) {
  const Case c = caseOf(chain("ties_chain.msh"));
  EXPECT_EQ(c.ties.levels, 3);
  EXPECT_LT(farthest(c), 1e-14);
  EXPECT_LT(ghostsOff(c.mesh), 1e-15);
  EXPECT_GT(farthest(caseOf(chain("ties_chain.msh") +
                            "-tie_low_adjust off -tie_side_adjust off -tie_between_adjust off")),
            0.5 * gap);
}

TEST(Ties, NodesMoveAlikeOnAnyNumberOfRanks) {
  const std::string options = chain("ties_chain.msh");
  const Case many = caseOf(options), one = caseOf(options, PETSC_COMM_SELF);
  std::map<PetscInt, Point> single;
  for (PetscInt i = 0; i < one.mesh.localNodes(); ++i)
    single[one.mesh.nodeTag[i]] = one.mesh.coordinates[i];
  double worst = 0;
  for (PetscInt i = 0; i < many.mesh.localNodes(); ++i)
    worst = std::max(worst, distance(many.mesh.coordinates[i], single.at(many.mesh.nodeTag[i])));
  EXPECT_LT(test::largest(worst), 1e-14);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &a = many.ties.reports.at(i), &b = one.ties.reports.at(i);
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.untied, b.untied);
    EXPECT_NEAR(a.largestAdjustment, b.largestAdjustment, 1e-14);
  }
}

// The lowest cells of the pad are 0.098 high, and come down by 0.02; with a pad of one cell the
// same way is 2 % of its height.
TEST(Ties, CellsThatAreStretchedAreToldWithTheFigure) {
  const auto options = [](int cellsUp) {
    return tied(layers("ties_strained.msh", quad4, 6, 8,
                       {quad4, {0, 0, cellsUp}, {0.25, 0, gap}, {2.25, 0, 1}}));
  };
  const std::string warning = test::warningsOf([&] { caseOf(options(10)); });
  for (const char* part : {"warning: tie 'low': moving 'pad_low' onto 'disc_high' changes "
                           "distances in 4 cells by more "
                           "than 10 %, at most by 20.4 % at (",
                           "; give a smaller -tie_low_tolerance, or -tie_low_adjust off\n"})
    EXPECT_TRUE(test::contains(warning, part)) << warning;
  EXPECT_EQ(test::warningsOf([&] { caseOf(options(1)); }).find("changes distances"),
            std::string::npos);
  EXPECT_EQ(test::warningsOf([&] {
              caseOf(options(10) + "-tie_low_adjust off");
            }).find("changes distances"),
            std::string::npos);
}

// The pad reaches further into the disc than its lowest cells are high.
TEST(Ties, FoldedCellsAreErrorsThatNameTheTie) {
  const std::string options =
      tied(layers("ties_folded.msh", quad4, 6, 8, {quad4, {0, 0, 10}, {0, 0, -0.3}, {1, 0, 1}})) +
      "-tie_low_tolerance 0.5 ";
  const std::string message = test::errorOf([&] { caseOf(options); });
  for (const char* part : {"-tie_low_adjust: moving 'pad_low' onto 'disc_high' folds 8 cells",
                           "(quad4) of group 'pad'", "moves by 0.3 m", "-tie_low_tolerance"})
    EXPECT_TRUE(test::contains(message, part)) << message;
  EXPECT_EQ(caseOf(options + "-tie_low_adjust off").ties.reports.at(0).nodes, 9);
}

}  // namespace
}  // namespace squeal
