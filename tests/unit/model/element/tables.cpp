// SPDX-License-Identifier: BSD-2-Clause
// The tables made at build time are those of gmsh, to the last bit.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <numeric>
#include <span>

#include "model/element/shape.hpp"
#include "support/model/gmsh_library.hpp"

namespace squeal {
namespace {

using element::ShapeTable;

constexpr int point = 15, lastType = 19;
const std::vector<int> pyramids{7, 14, 19};

bool isPyramid(int type) {
  return std::find(pyramids.begin(), pyramids.end(), type) != pyramids.end();
}

std::vector<std::uint64_t> bitsOf(std::span<const double> values) {
  std::vector<std::uint64_t> bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

std::vector<std::uint64_t> functions(int type, const std::vector<double>& points,
                                     const char* what) {
  int components = 0, orientations = 0;
  std::vector<double> values;
  gmsh::model::mesh::getBasisFunctions(type, points, what, components, values, orientations);
  return bitsOf(values);
}

/// Returns the element of first order with the corners of a type.
int firstOrder(const ShapeTable& table) {
  for (int type : {point, 1, 2, 3, 4, 5, 6, 7}) {
    const auto& linear = element::shapeTable(type);
    if (linear.dimension == table.dimension && linear.corners == table.corners) return type;
  }
  return 0;
}

void expectRule(const ShapeTable& table, int degree) {
  std::vector<double> points, weights;
  gmsh::model::mesh::getIntegrationPoints(table.type, "Gauss" + std::to_string(degree), points,
                                          weights);
  if (isPyramid(table.type)) {  // the weights of gmsh 4.8 have another sum than the volume
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (auto& weight : weights) weight *= 4.0 / 3.0 / sum;
  }
  EXPECT_EQ(bitsOf(table.point), bitsOf(points));
  EXPECT_EQ(bitsOf(table.weight), bitsOf(weights));
  EXPECT_EQ(bitsOf(table.value), functions(table.type, points, "Lagrange"));
  EXPECT_EQ(bitsOf(table.gradient), functions(table.type, points, "GradLagrange"));
}

void expectNodes(const ShapeTable& table) {
  std::string name;
  int dimension = 0, order = 0, nodes = 0, corners = 0;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(table.type, name, dimension, order, nodes, local,
                                          corners);
  EXPECT_EQ(table.gmshName, name);
  EXPECT_EQ(table.dimension, dimension);
  EXPECT_EQ(table.order, order);
  EXPECT_EQ(table.nodes, nodes);
  EXPECT_EQ(table.corners, corners);
  EXPECT_TRUE(table.name.ends_with(std::to_string(nodes))) << table.name;
  std::vector<double> places(std::size_t(3 * nodes), 0.0);
  for (int i = 0; i < nodes; ++i)
    for (int d = 0; d < dimension; ++d) places[3 * i + d] = local[i * dimension + d];
  EXPECT_EQ(bitsOf(table.nodeGradient), functions(table.type, places, "GradLagrange"));
  EXPECT_EQ(bitsOf(table.cornerValue), functions(firstOrder(table), places, "Lagrange"));
  EXPECT_EQ(bitsOf(table.centreGradient), functions(table.type, {0, 0, 0}, "GradLagrange"));
}

TEST(ElementTables, AreThoseOfGmsh) {
  test::startGmsh();
  for (int type = 1; type <= lastType; ++type) {
    SCOPED_TRACE(type);
    ASSERT_TRUE(element::isKnown(type));
    const auto& table = element::shapeTable(type);
    EXPECT_EQ(table.type, type);
    expectNodes(table);
    expectRule(table, 2 * table.order + 1);
  }
}

TEST(ElementTables, TheStiffnessOfQuadraticSimplicesHasADegreeLess) {
  test::startGmsh();
  for (int type = 1; type <= lastType; ++type) {
    SCOPED_TRACE(type);
    const auto& full = element::shapeTable(type);
    const auto& table = element::stiffnessTable(type);
    const bool reduced = full.name == "tri6" || full.name == "tet10";
    EXPECT_EQ(&table != &full, reduced);
    if (!reduced) continue;
    expectNodes(table);
    expectRule(table, 2);
    EXPECT_EQ(table.points(), table.corners);
  }
}

TEST(ElementTables, OnlyHex20HasReducedIntegration) {
  test::startGmsh();
  for (int type = 0; type <= lastType; ++type) {
    SCOPED_TRACE(type);
    const auto* table = element::underintegratedTable(type);
    ASSERT_EQ(table != nullptr, type == 17);
    if (!table) continue;
    expectNodes(*table);
    expectRule(*table, 3);
    EXPECT_EQ(table->points(), 8);
    EXPECT_EQ(element::shapeTable(type).points(), 27);
  }
}

TEST(ElementTables, OtherTypesAreUnknown) {
  for (int type : {-1, 0, 20, 21, 29, 31, 32, 92, 140, 1000}) EXPECT_FALSE(element::isKnown(type));
}

}  // namespace
}  // namespace squeal
