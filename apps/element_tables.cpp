// SPDX-License-Identifier: BSD-2-Clause
/// element_tables FILE: writes the shape functions and quadrature rules of all element types as the
/// C++ source of src/model/element/tables.hpp. The build runs it. The values are hexadecimal, so
/// that they are exactly those of gmsh.
#include <gmsh.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace {

// gmsh's numbers of the cells that the program supports, of their faces and edges, and of a point.
const std::vector<int> types{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
const std::vector<int> reducedTypes{9, 11};       // tri6, tet10: see stiffnessTable()
const std::vector<int> underintegratedTypes{17};  // hex20: see underintegratedTable()

/// The numbers of all tables, in the order of their members.
struct Numbers {
  std::string text;
  std::size_t count = 0;
  /// Adds numbers, and returns them as code.
  std::string add(const std::vector<double>& values) {
    const auto first = count;
    for (const double value : values) {
      char literal[32];
      std::snprintf(literal, sizeof literal, "%a,", value);
      text += literal;
      text += ++count % 8 == 0 ? "\n" : "";
    }
    return "{numbers + " + std::to_string(first) + ", " + std::to_string(values.size()) + "}";
  }
};

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
  static const std::map<std::pair<int, int>, int> linear{{{0, 1}, 15}, {{1, 2}, 1}, {{2, 3}, 2},
                                                         {{2, 4}, 3},  {{3, 4}, 4}, {{3, 8}, 5},
                                                         {{3, 6}, 6},  {{3, 5}, 7}};
  return linear.at({dimension, corners});
}

/// Returns the code of the table with a rule of this degree; 0 stands for 2·order + 1.
std::string tabulate(int type, int degree, Numbers& numbers) {
  std::string gmshName;
  int dimension = 0, order = 0, nodes = 0, corners = 0;
  std::vector<double> local, point, weight;
  gmsh::model::mesh::getElementProperties(type, gmshName, dimension, order, nodes, local, corners);
  // gmsh's odd-degree rules are the tensor-product ones on quadrilaterals and hexahedra.
  gmsh::model::mesh::getIntegrationPoints(
      type, "Gauss" + std::to_string(degree > 0 ? degree : 2 * order + 1), point, weight);
  if (dimension == 3 && corners == 5) {
    // gmsh 4.8 has the points of the pyramid right, but the sum of its weights is 16/9.
    const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
    for (auto& w : weight) w *= 4.0 / 3.0 / sum;  // the volume of its pyramid
  }
  std::vector<double> atNodes;
  for (int i = 0; i < nodes; ++i)
    for (int d = 0; d < 3; ++d) atNodes.push_back(d < dimension ? local[i * dimension + d] : 0.0);
  std::string code = "      {.type = " + std::to_string(type);
  for (const auto& [member, value] : {std::pair{"dimension", dimension},
                                      {"order", order},
                                      {"nodes", nodes},
                                      {"corners", corners}})
    code += std::string(", .") + member + " = " + std::to_string(value);
  code += ", .name = \"" + elementName(dimension, corners, nodes) + "\", .gmshName = \"" +
          gmshName + "\"";
  const auto add = [&](const char* member, const std::vector<double>& values) {
    code += std::string(",\n       .") + member + " = " + numbers.add(values);
  };
  add("weight", weight);
  add("point", point);
  add("value", basis(type, point, "Lagrange"));
  add("gradient", basis(type, point, "GradLagrange"));
  add("nodeGradient", basis(type, atNodes, "GradLagrange"));
  add("cornerValue", basis(linearType(dimension, corners), atNodes, "Lagrange"));
  add("centreGradient", basis(type, {0, 0, 0}, "GradLagrange"));
  return code + "},\n";
}

std::string functionOf(const std::string& name, const std::string& tables) {
  return "std::span<const ShapeTable> " + name + "() {\n  static const ShapeTable tables[] = {\n" +
         tables + "  };\n  return tables;\n}\n";
}

std::string source() {
  Numbers numbers;
  std::string full, reduced, underintegrated;
  for (const int type : types) full += tabulate(type, 0, numbers);
  for (const int type : reducedTypes) reduced += tabulate(type, 2, numbers);
  for (const int type : underintegratedTypes) underintegrated += tabulate(type, 3, numbers);
  return "// Written by element_tables with gmsh " GMSH_API_VERSION
         ".\n"
         "#include \"model/element/tables.hpp\"\n\n"
         "namespace squeal::element {\nnamespace {\nconst double numbers[] = {\n" +
         numbers.text + "};\n}  // namespace\n\n" + functionOf("fullTables", full) + "\n" +
         functionOf("reducedTables", reduced) + "\n" +
         functionOf("underintegratedTables", underintegrated) +
         "\n}  // namespace squeal::element\n";
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::fputs("usage: element_tables FILE\n", stderr);
    return 1;
  }
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  std::ofstream file(words[1]);
  file << source() << std::flush;
  gmsh::finalize();
  if (file) return 0;
  std::fprintf(stderr, "element_tables: cannot write '%s'\n", words[1]);
  return 1;
}
