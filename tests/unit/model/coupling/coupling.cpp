// SPDX-License-Identifier: BSD-2-Clause
// The coupling of two surfaces that are meshed apart: what it reproduces exactly, with faces of all
// types, with partial cover, with periodic images, on any number of ranks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/harness/ranks.hpp"
#include "support/model/coupled_surfaces.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using namespace test;

/// Returns a name for each pair of cells.
std::string file(int disc, int pad) {
  return "coupling_" + std::to_string(disc) + "_" + std::to_string(pad) + ".msh";
}

/// All pairs of cells, in space and in the plane.
std::vector<std::pair<int, int>> allPairs() {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& cells : {solidCells, planeCells})
    for (int a : cells)
      for (int b : cells) pairs.emplace_back(a, b);
  return pairs;
}

/// Two unit squares (intervals) on each other.
Case unitCase(int disc, int pad) {
  return caseOf(blocksApart(file(disc, pad), {disc, {3, 2, 1}, {0, 0, -1}, {1, 1, 0}},
                            {pad, {2, 3, 1}, {0, 0, 0}, {1, 1, 1}}));
}

void expectExact(const Defects& d, double tolerance = 1e-12) {
  EXPECT_GT(d.pivots, 0);
  EXPECT_LT(d.rowSum, tolerance);
  EXPECT_LT(d.linear, tolerance);
  EXPECT_LT(d.inverse, tolerance);
  EXPECT_LT(d.share, tolerance);
  EXPECT_LT(d.area, tolerance);
}

TEST(Coupling, ReproducesLinearFieldsOnFlatFacesOfAllTypes) {
  for (const auto& [disc, pad] : allPairs()) {
    SCOPED_TRACE(testing::Message() << "disc " << disc << ", pad " << pad);
    const Case c = unitCase(disc, pad);
    const Coupling coupling = padOnDisc(c.mesh);
    const Defects d = defectsOf(c, coupling);
    expectExact(d);
    EXPECT_NEAR(coupling.coveredArea, 1, 1e-12);
    EXPECT_NEAR(coupling.slave.area, 1, 1e-12);
    EXPECT_NEAR(coupling.master.area, 1, 1e-12);
    EXPECT_EQ(coupling.droppedNodes, 0);
    EXPECT_EQ(coupling.sliverFaces, 0);
    EXPECT_NEAR(d.least, 1, 1e-12);
    for (const auto& node : coupling.nodes) EXPECT_NEAR(node.gap, 0, 1e-14);
  }
}

// Pᵀ hands the loads of a uniform pressure on the slave to the master as those of a uniform
// pressure, if each face is integrated exactly.
TEST(Coupling, HandsOverUniformPressure) {
  for (const auto& [disc, pad] : allPairs()) {
    SCOPED_TRACE(testing::Message() << "disc " << disc << ", pad " << pad);
    const Case c = unitCase(disc, pad);
    const auto slave = nodalLoads(c, "pad_low"), master = nodalLoads(c, "disc_high");
    std::vector<double> handed(c.at.size(), 0.0);
    for (const auto& node : padOnDisc(c.mesh).nodes)
      for (const auto& [l, weight] : node.masters) handed[l] += weight * slave[c.global(node)];
    check(MPI_Allreduce(MPI_IN_PLACE, handed.data(), handed.size(), MPI_DOUBLE, MPI_SUM,
                        c.mesh.comm));
    double worst = 0;
    for (std::size_t l = 0; l < handed.size(); ++l)
      worst = std::max(worst, std::abs(handed[l] - master[l]));
    EXPECT_LT(worst, 1e-12);
  }
}

// The disc reaches beyond the pad on one side, the pad beyond the disc on the others.
TEST(Coupling, PartlyCoveredSlavesStayExact) {
  // All shifts on one rank, and each of them on two or on three.
  std::vector<double> shifts{0.17, 0.251, 0.4, 0.4999};
  if (sizeOf() == 2) shifts = {0.17, 0.4};
  if (sizeOf() == 3) shifts = {0.251, 0.4999};
  for (const double shift : shifts) {
    for (const auto& [disc, pad] : allPairs()) {
      SCOPED_TRACE(testing::Message() << "disc " << disc << ", pad " << pad << ", shift " << shift);
      const Case c = caseOf(blocksApart(file(disc, pad),
                                        {disc, {3, 2, 1}, {-0.3, 0.11, -1}, {1 - shift, 0.9, 0}},
                                        {pad, {4, 3, 1}, {0, 0, 0}, {1, 1, 1}}));
      const Coupling coupling = padOnDisc(c.mesh);
      const Defects d = defectsOf(c, coupling);
      expectExact(d, 1e-10);
      EXPECT_GT(d.least, 0);
      const double width = c.mesh.dimension == 2 ? 1 : 0.79;
      EXPECT_NEAR(coupling.coveredArea, (1 - shift) * width, 1e-12);
    }
  }
}

/// Expects on all ranks together what one rank finds.
void expectSameOnOneRank(const std::string& options, double distance = 0) {
  const Case many = caseOf(options), one = caseOf(options, PETSC_COMM_SELF);
  const Coupling found = padOnDisc(many.mesh, distance), single = padOnDisc(one.mesh, distance);
  const auto a = records(many, found), b = records(one, single);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 0U);
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a[i].size(); ++k)
      worst = std::max(worst, std::abs(a[i][k] - b[i][k]));
  EXPECT_LT(worst, 1e-12);
  EXPECT_EQ(found.droppedNodes, single.droppedNodes);
  EXPECT_EQ(found.sliverFaces, single.sliverFaces);
  EXPECT_EQ(found.slave.nearFaces, single.slave.nearFaces);
  EXPECT_EQ(found.master.nearFaces, single.master.nearFaces);
  EXPECT_NEAR(found.coveredArea, single.coveredArea, 1e-13);
  EXPECT_NEAR(found.largestGap, single.largestGap, 1e-13);
}

// With overhangs, so that nodes are dropped, and with a slave of two types of faces.
TEST(Coupling, IsTheSameOnAnyNumberOfRanks) {
  for (const int cell : {wedge15, hex20, hex27, hex8}) {
    Block pad{cell, {5, 4, 1}, {0, 0, 0}, {1, 1, 1}};
    if (cell == wedge15) pad.mixed = hex20;
    expectSameOnOneRank(
        blocksApart(file(0, cell), {hex20, {4, 5, 1}, {-0.3, 0.1, -1}, {0.7501, 1.2, 0}}, pad));
  }
  expectSameOnOneRank(blocksApart(file(0, 16), {10, {7, 1, 2}, {-0.3, 0, -1}, {0.7501, 1, 0}},
                                  {16, {9, 1, 2}, {0, 0, 0}, {1, 1, 1}}));
}

// A pad of 90 degrees on a ring whose rims it does not reach. Most of the ring is far away.
TEST(Coupling, PadsRestOnRings) {
  for (const int cell : {wedge15, hex20, hex27, hex8}) {
    SCOPED_TRACE(cell);
    const Block disc{cell, {24, 3, 1}, {0, 0, -1}, {1, 1, 0}, 0, 0, ring},
        pad{cell, {7, 4, 1}, {0.1, 0.2, 0}, {0.35, 0.8, 1}, 0, 0, ring};
    const std::string options = blocksApart(file(1, cell), disc, pad);
    const Case c = caseOf(options);
    for (const bool padIsSlave : {true, false}) {
      const std::string slave = padIsSlave ? "pad_low" : "disc_high",
                        master = padIsSlave ? "disc_high" : "pad_low";
      const Coupling coupling =
          coupling::couple(c.mesh, coupling::NodeExchange(c.mesh), {slave, master}, {},
                           std::vector<unsigned char>(c.mesh.localNodes(), 0));
      const Defects d = defectsOf(c, coupling);
      expectExact(d, 1e-10);
      const double exact = std::numbers::pi / 4 * (1.8 * 1.8 - 1.2 * 1.2);
      // Chords, or parabolas, in place of arcs.
      EXPECT_NEAR(coupling.coveredArea, exact, cell == hex8 ? 2e-2 : 1e-3);
      EXPECT_GT(d.least, 0);
      EXPECT_EQ(coupling.slave.faces,
                padIsSlave ? (cell == wedge15 ? 56 : 28) : (cell == wedge15 ? 144 : 72));
      EXPECT_EQ(padIsSlave, coupling.slave.nearFaces == coupling.slave.faces);
      // A node whose faces are all near the pad has its own area; no node has none.
      for (const auto& node : coupling.nodes) EXPECT_GT(node.wholeArea, 0);
    }
    expectSameOnOneRank(options);
  }
}

// ∫ φ̃ dA counts faces that nothing covers: here the master ends where faces of the slave do.
TEST(Coupling, WholeAreasCountFacesThatNothingCovers) {
  for (const int cell : {wedge15, hex20, hex27, hex8}) {
    SCOPED_TRACE(cell);
    const Case half = caseOf(blocksApart(file(2, cell), {cell, {3, 3, 1}, {0.5, 0, -1}, {1, 1, 0}},
                                         {cell, {4, 4, 1}, {0, 0, 0}, {1, 1, 1}, 0}));
    const Case full = caseOf(blocksApart(file(3, cell), {cell, {3, 3, 1}, {0, 0, -1}, {1, 1, 0}},
                                         {cell, {4, 4, 1}, {0, 0, 0}, {1, 1, 1}, 0}));
    std::map<std::array<long, 2>, double> whole;
    const auto key = [](const Record& r) {
      return std::array<long, 2>{std::lround(1e6 * r[0]), std::lround(1e6 * r[1])};
    };
    for (const auto& r : records(full, padOnDisc(full.mesh))) whole[key(r)] = r[7];
    const auto covered = records(half, padOnDisc(half.mesh));
    ASSERT_GT(covered.size(), 0U);
    for (const auto& r : covered) EXPECT_NEAR(r[7], whole.at(key(r)), 1e-14);
  }
}

// A pad that begins at another place of the period leaves the disc at one end and comes in again at
// the other one. On what covers it there, sin(2π x) is the same as on the periodic disc, and a node
// is as far from its place on the master, which is flat, as the surfaces are apart.
TEST(Coupling, PeriodicSurfacesGoOnBeyondTheirEnds) {
  for (const double shift : {0.3, -0.55})
    for (const int cell : {3, 10, int(hex8), int(hex27)}) {
      SCOPED_TRACE(testing::Message() << cell << ", " << shift);
      std::string options =
          blocksApart(file(5, cell), {cell, {12, 3, 1}, {0, 0, -1}, {1, 1, 0}, 0},
                      {cell, {10, 4, 1}, {shift, 0, 0.01}, {1 + shift, 1, 1}, 0}) +
          "-constraint_disc_x1_image_of disc_x0 -constraint_pad_x1_image_of pad_x0 ";
      if (cell == hex8 || cell == hex27)
        options += "-constraint_disc_y1_image_of disc_y0 -constraint_pad_y1_image_of pad_y0 ";
      const Case c = caseOf(options);
      const Coupling coupling = padOnDisc(c.mesh);
      EXPECT_NEAR(coupling.coveredArea, 1, 1e-13);
      EXPECT_EQ(coupling.droppedNodes, 0);
      EXPECT_NEAR(coupling.master.nearArea, 1, 1e-13);
      const double height = c.mesh.dimension - 1;
      double away = 0, field = 0;
      for (const auto& node : coupling.nodes) {
        Point flat{};
        flat[std::size_t(height)] = -0.01;
        for (std::size_t d = 0; d < 3; ++d)
          away = std::max(away, std::abs(node.offset[d] - flat[d]));
        double value = 0;
        for (const auto& [l, weight] : node.masters)
          value += weight * std::sin(2 * std::numbers::pi * c.at[l][0]);
        field =
            std::max(field, std::abs(value - std::sin(2 * std::numbers::pi * c.place(node)[0])));
      }
      EXPECT_LT(largest(away), 1e-13);
      EXPECT_LT(largest(field), cell == 3 || cell == hex8 ? 0.05 : 0.005);  // cells of 30°
    }
}

// Blocks of period 1 whose meshes repeat twice: what belongs to x belongs to x + 1/2, also where
// nodes are images.
TEST(Coupling, PeriodicImagesCountAsOneNode) {
  for (const int cell : {wedge15, hex20, hex27, hex8}) {
    SCOPED_TRACE(cell);
    const std::string options =
        blocksApart(file(4, cell), {cell, {8, 2, 1}, {0, 0, -1}, {1, 1, 0}, 0},
                    {cell, {12, 4, 1}, {0, 0, 0}, {1, 1, 1}, 0}) +
        "-constraint_disc_x1_image_of disc_x0 -constraint_pad_x1_image_of pad_x0 "
        "-constraint_disc_y1_image_of disc_y0 -constraint_pad_y1_image_of pad_y0 ";
    const Case c = caseOf(options);
    const Coupling coupling = padOnDisc(c.mesh);
    EXPECT_NEAR(coupling.coveredArea, 1, 1e-13);
    const auto found = records(c, coupling);
    double area = 0;
    for (const auto& node : found) area += node[6];
    EXPECT_NEAR(area, 1, 1e-13);
    // P of a field of period 1/2
    std::map<std::array<long, 2>, std::vector<std::array<double, 3>>> values;
    for (const auto& node : coupling.nodes) {
      const Point& x = c.place(node);
      EXPECT_LT(x[0], 1 - 1e-9);
      EXPECT_LT(x[1], 1 - 1e-9);
      double value = 0, sum = 0;
      for (const auto& [l, weight] : node.masters) {
        EXPECT_LT(c.at[l][0], 1 - 1e-9);
        EXPECT_LT(c.at[l][1], 1 - 1e-9);
        sum += weight;
        value += weight * std::sin(4 * std::numbers::pi * c.at[l][0]) *
                 std::cos(2 * std::numbers::pi * c.at[l][1]);
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      values[{std::lround(2e6 * x[0]) % 1000000, std::lround(1e6 * x[1])}].push_back(
          {value, node.area, node.wholeArea});
    }
    int size = 1;
    check(MPI_Comm_size(c.mesh.comm, &size));
    if (size == 1)
      for (const auto& [place, list] : values) {
        ASSERT_EQ(list.size(), 2U);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(list[0][k], list[1][k], 1e-13);
      }
    expectSameOnOneRank(options);
  }
}

// Only the rank that has the face can notice; all of them say so.
TEST(Coupling, FoldedFacesAreNamedOnAllRanks) {
  const auto arch = [](const Point& x) { return Point{x[0], x[1], x[2] - 20 * x[0] * (1 - x[0])}; };
  const Case c = caseOf(blocksApart(file(5, 10), {10, {3, 1, 2}, {0, 0, -1}, {1, 1, 0}},
                                    {10, {1, 1, 3}, {0, 0, 0}, {1, 1, 1}, 0, 0, arch}));
  const std::string message = errorOf([&] { padOnDisc(c.mesh, 20); });
  EXPECT_TRUE(contains(message, "surface 'pad_low' near (0, 0, 0): a face on the slave side") &&
              contains(message, "refine it"))
      << message;
}

}  // namespace
}  // namespace squeal
