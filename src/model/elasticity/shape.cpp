// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/shape.hpp"

#include <gmsh.h>

#include <map>
#include <numeric>

namespace squeal::elasticity {
namespace {

std::vector<double> basis(int type, const std::vector<double>& points, const char* what) {
  int components = 0, orientations = 0;
  std::vector<double> values;
  gmsh::model::mesh::getBasisFunctions(type, points, what, components, values, orientations);
  return values;
}

std::string elementName(int dimension, int corners, int nodes) {
  const char* shape = "element";
  if (dimension == 0) shape = "point";
  if (dimension == 1) shape = "line";
  if (dimension == 2) shape = corners == 3 ? "tri" : "quad";
  if (dimension == 3)
    shape = corners == 4 ? "tet" : corners == 5 ? "pyramid" : corners == 6 ? "wedge" : "hex";
  return shape + std::to_string(nodes);
}

/// Returns the gmsh type of first order with these corners.
int linearType(int dimension, int corners) {
  static const std::map<std::pair<int, int>, int> types{{{0, 1}, 15}, {{1, 2}, 1}, {{2, 3}, 2},
                                                        {{2, 4}, 3},  {{3, 4}, 4}, {{3, 8}, 5},
                                                        {{3, 6}, 6},  {{3, 5}, 7}};
  return types.at({dimension, corners});
}

/// Returns the table with a rule of this degree; 0 stands for 2·order + 1.
ShapeTable tabulate(int type, int degree) {
  ShapeTable table;
  std::string gmshName;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, gmshName, table.dimension, table.order, table.nodes,
                                          local, table.corners);
  table.type = type;
  table.name = elementName(table.dimension, table.corners, table.nodes);
  // gmsh's odd-degree rules are the tensor-product ones on quadrilaterals and hexahedra.
  gmsh::model::mesh::getIntegrationPoints(
      type, "Gauss" + std::to_string(degree > 0 ? degree : 2 * table.order + 1), table.point,
      table.weight);
  if (table.dimension == 3 && table.corners == 5) {
    // gmsh 4.8 has the points of the pyramid right, but the sum of its weights is 16/9.
    const double sum = std::accumulate(table.weight.begin(), table.weight.end(), 0.0);
    for (auto& weight : table.weight) weight *= 4.0 / 3.0 / sum;  // the volume of its pyramid
  }
  table.value = basis(type, table.point, "Lagrange");
  table.gradient = basis(type, table.point, "GradLagrange");
  std::vector<double> nodes;
  for (int i = 0; i < table.nodes; ++i)
    for (int d = 0; d < 3; ++d)
      nodes.push_back(d < table.dimension ? local[i * table.dimension + d] : 0.0);
  table.nodeGradient = basis(type, nodes, "GradLagrange");
  table.cornerValue = basis(linearType(table.dimension, table.corners), nodes, "Lagrange");
  table.centreGradient = basis(type, {0, 0, 0}, "GradLagrange");
  return table;
}

}  // namespace

const ShapeTable& shapeTable(int gmshType) {
  static std::map<int, ShapeTable> tables;
  const auto found = tables.find(gmshType);
  return found != tables.end() ? found->second
                               : tables.emplace(gmshType, tabulate(gmshType, 0)).first->second;
}

const ShapeTable& stiffnessTable(int gmshType) {
  static std::map<int, ShapeTable> tables;
  const ShapeTable& full = shapeTable(gmshType);
  if (full.name != "tri6" && full.name != "tet10") return full;
  const auto found = tables.find(gmshType);
  return found != tables.end() ? found->second
                               : tables.emplace(gmshType, tabulate(gmshType, 2)).first->second;
}

}  // namespace squeal::elasticity
