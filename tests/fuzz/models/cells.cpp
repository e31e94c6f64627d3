// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/models/cells.hpp"

namespace squeal::fuzz {
namespace {

using Corners = std::vector<std::vector<int>>;  // [element or face][corner]

/// A family of elements by its corners; numbers are gmsh's.
struct Family {
  int cornerCount;
  Corners inCell;       ///< corners of the lattice's cell that its elements have
  Corners edges;        ///< in gmsh's order
  Corners quadrangles;  ///< faces of four corners, in gmsh's order
  Corners triangles;    ///< faces of three corners
  bool edgesAreFaces = false;
};

// Corners of a cell: 0 to 3 below counterclockwise, 4 to 7 above them.
constexpr int cellCorner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

const Family triangle{3, {{0, 1, 2}, {0, 2, 3}}, {{0, 1}, {1, 2}, {2, 0}}, {}, {}, true};
const Family quadrangle{4, {{0, 1, 2, 3}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {}, {}, true};
// Six tetrahedra about the diagonal from corner 0 to corner 6 (Kuhn): neighbouring cells match.
const Family tetrahedron{
    4,
    {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}},
    {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}},
    {},
    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
const Family wedge{6,
                   {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}},
                   {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}},
                   {{0, 1, 4, 3}, {0, 2, 5, 3}, {1, 2, 5, 4}},
                   {{0, 1, 2}, {3, 4, 5}}};
const Family hexahedron{
    8,
    {{0, 1, 2, 3, 4, 5, 6, 7}},
    {{0, 1},
     {0, 3},
     {0, 4},
     {1, 2},
     {1, 5},
     {2, 3},
     {2, 6},
     {3, 7},
     {4, 5},
     {4, 7},
     {5, 6},
     {6, 7}},
    {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}},
    {}};

/// What a shape is made of. Faces: gmsh's numbers of the types with 2, 3 and 4 corners.
struct Pattern {
  Shape shape;
  const char* name;
  int dimension, order;
  const Family* family;
  int type, lineType, triangleType, quadrangleType;
  bool middles;  ///< nodes in the middle of quadrangles and hexahedra
};

const std::vector<Pattern> patterns{{Shape::tri3, "tri3", 2, 1, &triangle, 2, 1, 0, 0, false},
                                    {Shape::tri6, "tri6", 2, 2, &triangle, 9, 8, 0, 0, false},
                                    {Shape::quad4, "quad4", 2, 1, &quadrangle, 3, 1, 0, 0, false},
                                    {Shape::quad8, "quad8", 2, 2, &quadrangle, 16, 8, 0, 0, false},
                                    {Shape::quad9, "quad9", 2, 2, &quadrangle, 10, 8, 0, 0, true},
                                    {Shape::tet4, "tet4", 3, 1, &tetrahedron, 4, 0, 2, 0, false},
                                    {Shape::tet10, "tet10", 3, 2, &tetrahedron, 11, 0, 9, 0, false},
                                    {Shape::wedge6, "wedge6", 3, 1, &wedge, 6, 0, 2, 3, false},
                                    {Shape::wedge15, "wedge15", 3, 2, &wedge, 18, 0, 9, 16, false},
                                    {Shape::hex8, "hex8", 3, 1, &hexahedron, 5, 0, 0, 3, false},
                                    {Shape::hex20, "hex20", 3, 2, &hexahedron, 17, 0, 0, 16, false},
                                    {Shape::hex27, "hex27", 3, 2, &hexahedron, 12, 0, 0, 10, true}};

const Pattern& patternOf(Shape shape) {
  for (const auto& pattern : patterns)
    if (pattern.shape == shape) return pattern;
  return patterns.front();
}

Place middleOf(const std::vector<Place>& corners, const std::vector<int>& numbers) {
  Place sum{};
  for (int n : numbers)
    for (int a = 0; a < 3; ++a) sum[a] += corners[n][a];
  for (int a = 0; a < 3; ++a) sum[a] /= static_cast<int>(numbers.size());
  return sum;
}

/// An element by its corners, with the nodes in the middle of `edges`, of `quadrangles` and, if
/// `centre` is set, of all corners.
Element completed(int type, std::vector<Place> corners, const Corners& edges,
                  const Corners& quadrangles, bool centre) {
  Element element{type, corners, std::move(corners)};
  for (const auto& edge : edges) element.nodes.push_back(middleOf(element.corners, edge));
  for (const auto& face : quadrangles) element.nodes.push_back(middleOf(element.corners, face));
  if (!centre) return element;
  std::vector<int> all(element.corners.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  element.nodes.push_back(middleOf(element.corners, all));
  return element;
}

std::vector<Place> picked(const std::vector<Place>& corners, const std::vector<int>& numbers) {
  std::vector<Place> some;
  for (int n : numbers) some.push_back(corners[n]);
  return some;
}

}  // namespace

std::vector<Shape> shapesOf(int dimension) {
  std::vector<Shape> shapes;
  for (const auto& pattern : patterns)
    if (pattern.dimension == dimension) shapes.push_back(pattern.shape);
  return shapes;
}

const char* text(Shape shape) { return patternOf(shape).name; }

int orderOf(Shape shape) { return patternOf(shape).order; }

std::vector<Element> elementsOf(Shape shape, const Place& low) {
  const Pattern& pattern = patternOf(shape);
  const bool quadratic = pattern.order == 2;
  std::vector<Element> elements;
  for (const auto& numbers : pattern.family->inCell) {
    std::vector<Place> corners;
    for (int n : numbers) {
      Place corner = low;
      for (int a = 0; a < 3; ++a) corner[a] += 2 * cellCorner[n][a];
      corners.push_back(corner);
    }
    elements.push_back(
        completed(pattern.type, std::move(corners), quadratic ? pattern.family->edges : Corners{},
                  pattern.middles ? pattern.family->quadrangles : Corners{}, pattern.middles));
  }
  return elements;
}

std::vector<Element> facesOf(Shape shape, const Element& element) {
  const Pattern& pattern = patternOf(shape);
  const Family& family = *pattern.family;
  const bool quadratic = pattern.order == 2;
  std::vector<Element> faces;
  const auto add = [&](int type, const Corners& all, const Corners& edges, bool centre) {
    for (const auto& numbers : all)
      faces.push_back(completed(type, picked(element.corners, numbers),
                                quadratic ? edges : Corners{}, {}, quadratic && centre));
  };
  if (family.edgesAreFaces) {
    add(pattern.lineType, family.edges, {{0, 1}}, false);
  } else {
    add(pattern.triangleType, family.triangles, triangle.edges, false);
    add(pattern.quadrangleType, family.quadrangles, quadrangle.edges, pattern.middles);
  }
  return faces;
}

}  // namespace squeal::fuzz
