// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A ShapeTable holds the shape functions and a quadrature rule of one element type, tabulated by
/// the gmsh library for any nodal Lagrange or serendipity element that it knows.
#include <string>
#include <vector>

namespace squeal::elasticity {

struct ShapeTable {
  int type = 0, dimension = 0, order = 0, nodes = 0, corners = 0;
  std::string name;                  ///< tri3, tri6, quad4, …, hex27, pyramid14
  std::vector<double> weight;        ///< [point]
  std::vector<double> point;         ///< [point][3] reference coordinates
  std::vector<double> value;         ///< [point][node]
  std::vector<double> gradient;      ///< [point][node][3] with respect to the reference coordinates
  std::vector<double> nodeGradient;  ///< [node as a point][node][3]
  std::vector<double> cornerValue;   ///< [node][corner] linear shape functions of the corners
  /// [node][3] at the centre of a line, quadrilateral or hexahedron
  std::vector<double> centreGradient;

  int points() const { return weight.size(); }
};

/// Returns the table of a gmsh element type, made on first use. Its rule integrates polynomials of
/// the degree 2·order + 1 exactly. The shape functions of pyramids are rational, with the limit 0
/// or 1 at the apex; those of (Bergot, Cohen and Duruflé 2010) are polynomials in the coordinates
/// of the cube that collapses to the pyramid, in which its rule is a product of Gauss rules and as
/// exact for them. Not collective.
const ShapeTable& shapeTable(int gmshType);
/// Returns the table with the smallest rule that the stiffness needs. tri6 has three and tet10 four
/// points, which is exact where the cell is straight; degree 2 keeps the order of convergence
/// (Ciarlet and Raviart 1972). These points lie further inside, where many curved cells have
/// det J > 0 although it changes its sign near an edge. All other cells have the rule of
/// shapeTable().
const ShapeTable& stiffnessTable(int gmshType);

}  // namespace squeal::elasticity
