// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Surfaces made of faces of one type over the unit square, or of lines over the unit interval.
#include <array>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "model/mortar/basis.hpp"
#include "model/mortar/face.hpp"
#include "support/algebra/dense.hpp"

namespace squeal::test {

using mesh::Point;

/// gmsh's numbers of the types of faces.
inline constexpr int line2 = 1, tri3 = 2, quad4 = 3, line3 = 8, tri6 = 9, quad9 = 10, quad8 = 16;
inline const std::vector<int> surfaceTypes{tri3, tri6, quad4, quad8, quad9},
    lineTypes{line2, line3};

/// Returns all pairs of types, of a slave and of a master, in space and in the plane.
inline std::vector<std::pair<int, int>> allPairs() {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& types : {surfaceTypes, lineTypes})
    for (const int slave : types)
      for (const int master : types) pairs.emplace_back(slave, master);
  return pairs;
}

/// A surface; its normal is +z (−y for lines) times the sign, before it is mapped.
struct FacePatch {
  std::vector<mortar::Face> faces;
  std::vector<Point> points;  ///< [global node]

  std::vector<const mortar::Face*> pointers() const {
    std::vector<const mortar::Face*> list;
    for (const auto& face : faces) list.push_back(&face);
    return list;
  }
};

/// Maps a point of the square (or of the x axis) to space.
using Map = std::function<Point(const Point&)>;
inline Point asItIs(const Point& x) { return x; }

/// Returns the lines of a grid from 0 to 1 that are not quite equally spaced.
inline std::vector<double> unequal(int cells, double amount, std::mt19937& generator) {
  std::vector<double> lines;
  for (int i = 0; i <= cells; ++i)
    lines.push_back((i + (i % cells ? amount * uniform(generator) : 0)) / cells);
  return lines;
}

/// Returns the corner nodes of each face of a grid, and appends the nodes themselves.
inline std::vector<std::vector<int>> gridCorners(const mortar::FaceType& type,
                                                 const std::vector<double>& x,
                                                 const std::vector<double>& y,
                                                 std::vector<Point>& nodes) {
  const int nx = x.size(), ny = type.dimension == 1 ? 1 : y.size();
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) nodes.push_back({x[i], type.dimension == 1 ? 0 : y[j], 0});
  std::vector<std::vector<int>> corners;
  if (type.dimension == 1)
    for (int i = 0; i + 1 < nx; ++i) corners.push_back({i, i + 1});
  else
    for (int j = 0; j + 1 < ny; ++j)
      for (int i = 0; i + 1 < nx; ++i) {
        const int a = i + nx * j, b = a + 1, c = b + nx, d = a + nx;
        if (type.corners == 4)
          corners.push_back({a, b, c, d});
        else if ((i + j) % 2)
          corners.insert(corners.end(), {{a, b, c}, {a, c, d}});
        else
          corners.insert(corners.end(), {{b, c, d}, {a, b, d}});
      }
  return corners;
}

/// Returns the faces over the cells of a grid, two triangles each or one quadrilateral. Corners
/// inside the square are moved by up to `jitter` at random first.
inline FacePatch facePatch(int gmshType, const std::vector<double>& x, const std::vector<double>& y,
                           int sign, double jitter = 0, const Map& map = asItIs) {
  const mortar::FaceType& type = mortar::faceType(gmshType);
  std::vector<Point> nodes;
  const auto cells = gridCorners(type, x, y, nodes);
  std::mt19937 generator(7);
  for (auto& node : nodes)
    for (int d = 0; d < 2; ++d)
      if (node[0] > 0 && node[0] < 1 && node[1] > 0 && node[1] < 1)
        node[d] += jitter * uniform(generator);
  std::map<std::pair<int, int>, int> middles;
  FacePatch patch;
  for (std::vector<int> list : cells) {
    for (const auto& edge : type.edges) {
      const int a = list[edge.corners[0]], b = list[edge.corners[1]];
      const auto [found, isNew] = middles.try_emplace(std::minmax(a, b), nodes.size());
      if (isNew)
        nodes.push_back({(nodes[a][0] + nodes[b][0]) / 2, (nodes[a][1] + nodes[b][1]) / 2, 0});
      list.push_back(found->second);
    }
    if (gmshType == quad9) {
      Point centre{};
      for (int c = 0; c < 4; ++c)
        for (int d = 0; d < 2; ++d) centre[d] += nodes[list[c]][d] / 4;
      list.push_back(nodes.size());
      nodes.push_back(centre);
    }
    mortar::Face face{gmshType, {}, std::vector<int>(list.size(), 0), {}, sign, 0};
    for (const int node : list) {
      face.nodes.push_back(node);
      face.points.push_back(map(nodes[node]));
    }
    patch.faces.push_back(face);
  }
  for (const Point& node : nodes) patch.points.push_back(map(node));
  return patch;
}

/// Returns a grid of about `cells` faces along each side whose faces are affine: unequal rectangles
/// for quadrilaterals, any triangles, and lines with their node in the middle.
inline FacePatch affinePatch(int gmshType, int cells, int sign, double height = 0) {
  std::mt19937 generator(cells);
  const auto x = unequal(cells, 0.2, generator), y = unequal(cells, 0.2, generator);
  const auto& type = mortar::faceType(gmshType);
  const double jitter = type.corners == 3 ? 0.2 / cells : 0;
  return facePatch(gmshType, x, y, sign, jitter, [&](const Point& p) {
    return type.dimension == 1 ? Point{p[0], height, 0} : Point{p[0], p[1], height};
  });
}

}  // namespace squeal::test
