// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The element types of the generated meshes, as patterns within a cell of a lattice.
#include <array>
#include <string>
#include <vector>

namespace squeal::fuzz {

/// A place of the lattice: corners of its cells have even coordinates, nodes in the middle of
/// edges, faces and cells odd ones.
using Place = std::array<int, 3>;

/// The element types of a mesh whose cells are cut into elements.
enum class Shape {
  tri3,
  tri6,
  quad4,
  quad8,
  quad9,
  tet4,
  tet10,
  wedge6,
  wedge15,
  hex8,
  hex20,
  hex27
};
/// All shapes of a dimension.
std::vector<Shape> shapesOf(int dimension);
const char* text(Shape shape);
/// 1 for linear elements, 2 for quadratic ones.
int orderOf(Shape shape);

/// Nodes of one element or of one of its faces, in gmsh's order, with gmsh's number of the type.
struct Element {
  int type = 0;
  std::vector<Place> nodes;
  std::vector<Place> corners;
};

/// Returns the elements that fill the cell whose lowest corner is `low`.
std::vector<Element> elementsOf(Shape shape, const Place& low);
/// Returns the faces of an element (in the plane, its edges). The order of their nodes does not
/// define the direction of the normal.
std::vector<Element> facesOf(Shape shape, const Element& element);

}  // namespace squeal::fuzz
