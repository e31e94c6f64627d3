// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Shape functions and quadrature rules of the elements, tabulated by gmsh when the program is
/// built (apps/element_tables.cpp). Not collective.
#include <span>
#include <string>

namespace squeal::element {

/// The shape functions and a quadrature rule of one element type. The values live as long as the
/// program.
struct ShapeTable {
  int type = 0, dimension = 0, order = 0, nodes = 0, corners = 0;
  std::string name;                  ///< point1, line2, tri3, …, hex27, pyramid14
  std::string gmshName;              ///< gmsh's name, such as "Tetrahedron 10"
  std::span<const double> weight;    ///< [point]
  std::span<const double> point;     ///< [point][3] reference coordinates
  std::span<const double> value;     ///< [point][node]
  std::span<const double> gradient;  ///< [point][node][3] with respect to the reference coordinates
  std::span<const double> nodeGradient;    ///< [node of evaluation][node][3]
  std::span<const double> cornerValue;     ///< [node][corner] linear shape functions of the corners
  std::span<const double> centreGradient;  ///< [node][3] at the centre of a line, quadrilateral or
                                           ///< hexahedron

  int points() const { return weight.size(); }
};

/// Returns true if there is a table of a gmsh element type: the supported cells, their faces and
/// edges, and points.
bool isKnown(int gmshType);
/// Returns the table of a gmsh element type, which must be known. Its rule integrates polynomials
/// of the degree 2·order + 1 exactly. The shape functions of pyramids are rational and tend to 0 or
/// 1 at the apex. They are polynomials in the coordinates of the cube that collapses to the pyramid
/// (Bergot, Cohen and Duruflé 2010). The rule of a pyramid is a product of Gauss rules in the
/// coordinates of the cube, and is exact for polynomials of the same degree in these coordinates.
const ShapeTable& shapeTable(int gmshType);
/// Returns the table with the smallest rule that the stiffness needs. For tri6 this rule has three
/// points, and for tet10 four. It is exact for cells with straight edges; on curved cells its
/// degree of 2 preserves the order of convergence (Ciarlet and Raviart 1972). Its points lie
/// further inside the cell, where many curved cells have det J > 0 even if det J changes its sign
/// near an edge. For all other cells, the rule is that of shapeTable().
const ShapeTable& stiffnessTable(int gmshType);
/// Returns the table of hex20 with the rule of reduced integration, 2×2×2 points; null for any
/// other type. A cell with this rule has 6 hourglass modes: motions that are not rigid but have no
/// strain at these points.
const ShapeTable* underintegratedTable(int gmshType);

}  // namespace squeal::element
