// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Faces of all types, at random places and curved at random; the same on every rank and machine.
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "model/element/shape.hpp"
#include "model/mortar/face.hpp"

namespace squeal::test {

using mesh::Point;
using mortar::Face;

inline double fraction(std::mt19937& random) {
  return static_cast<double>(random()) / 4294967296.0;
}

/// gmsh's types of faces: line2, line3, tri3, tri6, quad4, quad8, quad9.
inline constexpr int faceTypes[] = {1, 8, 2, 9, 3, 16, 10};

/// A face with its corners on a circle of this radius; its other nodes leave the middle of their
/// edge, or of the face, by up to `bulge` per component.
inline Face randomFace(std::mt19937& random, int type, const Point& centre, double radius,
                       double bulge) {
  const auto& table = element::shapeTable(type);
  Face face;
  face.type = type;
  const auto bulging = [&](Point p) {
    for (auto& x : p) x += bulge * (2 * fraction(random) - 1);
    return p;
  };
  const double turn = 2 * M_PI * fraction(random);
  const int corners = table.corners, edges = table.dimension == 1 ? 1 : corners;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * M_PI * i / corners;
    face.points.push_back({centre[0] + radius * std::cos(angle),
                           centre[1] + radius * std::sin(angle),
                           centre[2] + radius * (fraction(random) - 0.5)});
  }
  for (std::size_t e = 0; table.order == 2 && e < static_cast<std::size_t>(edges); ++e) {
    const Point &a = face.points[e], &b = face.points[(e + 1) % static_cast<std::size_t>(corners)];
    face.points.push_back(bulging({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}));
  }
  if (type == 10) face.points.push_back(bulging(centre));
  return face;
}

/// Faces of all types in the unit cube, the same on every rank. Node numbers tell face from face.
inline std::vector<Face> randomFaces(std::uint32_t seed, int count) {
  std::mt19937 random(seed);
  std::vector<Face> faces;
  for (int i = 0; i < count; ++i) {
    const Point centre{fraction(random), fraction(random), fraction(random)};
    faces.push_back(randomFace(random, faceTypes[i % 7], centre, 0.06, 0.02));
    Face& face = faces.back();
    for (std::size_t n = 0; n < face.points.size(); ++n) {
      face.nodes.push_back(10 * i + static_cast<PetscInt>(n));
      face.parts.push_back((i + static_cast<int>(n)) % 3);
    }
    face.sign = i % 2 ? 1 : -1;
    face.body = i % 5;
  }
  return faces;
}

}  // namespace squeal::test
