#pragma once
/// Shape functions and quadrature of one element type, tabulated by the gmsh library: any nodal
/// Lagrange or serendipity element it knows.
#include <string>
#include <vector>

namespace squeal::elasticity {

struct ShapeTable {
  int type = 0, dimension = 0, order = 0, nodes = 0, corners = 0;
  std::string name;                  ///< tri3, tri6, quad4, …, hex27
  std::vector<double> weight;        ///< [point]
  std::vector<double> point;         ///< [point][3] reference coordinates
  std::vector<double> value;         ///< [point][node]
  std::vector<double> gradient;      ///< [point][node][3] with respect to the reference coordinates
  std::vector<double> nodeGradient;  ///< [node as a point][node][3]
  /// [node][3] at the centre of a line, quadrilateral or hexahedron
  std::vector<double> centreGradient;

  int points() const { return static_cast<int>(weight.size()); }
};

/// Tabulated on first use; the rule integrates polynomials of degree 2·order + 1. Not collective.
const ShapeTable& shapeTable(int gmshType);
/// The same with the least rule that the stiffness needs. On tri6 and tet10 three and four points,
/// exact where the cell is straight (degree 2 keeps the order of convergence, Ciarlet and Raviart
/// 1972). They lie further inside, where many a curved cell is sound although its det J changes
/// sign near an edge. All other cells: the rule of shapeTable.
const ShapeTable& stiffnessTable(int gmshType);

}  // namespace squeal::elasticity
