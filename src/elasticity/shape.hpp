#pragma once
/// Shape functions and quadrature of one element type, tabulated by the gmsh library: any nodal Lagrange or serendipity element it
/// knows.
#include <string>
#include <vector>

namespace squeal::elasticity {

struct ShapeTable {
  int type = 0, dimension = 0, order = 0, nodes = 0, corners = 0;
  std::string name;                    ///< tri3, tri6, quad4, …, hex27
  std::vector<double> weight;          ///< [point]
  std::vector<double> point;           ///< [point][3] reference coordinates
  std::vector<double> value;           ///< [point][node]
  std::vector<double> gradient;        ///< [point][node][3] with respect to the reference coordinates
  std::vector<double> nodeGradient;    ///< [node as a point][node][3]
  std::vector<double> centreGradient;  ///< [node][3] at the centre of a line, quadrilateral or hexahedron

  int points() const { return static_cast<int>(weight.size()); }
};

/// Tabulated on first use; the rule integrates polynomials of degree 2·order + 1. Not collective.
const ShapeTable& shapeTable(int gmshType);

}  // namespace squeal::elasticity
