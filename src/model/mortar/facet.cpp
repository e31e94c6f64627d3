// SPDX-License-Identifier: BSD-2-Clause
#include "model/mortar/facet.hpp"

#include <algorithm>
#include <cmath>

#include "model/mesh/vector.hpp"
#include "model/mortar/surface.hpp"

namespace squeal::mortar {

using mesh::cross;
using mesh::dot;
using mesh::length;
using mesh::minus;
using mesh::plus;
using mesh::scaled;
using mesh::unit;

namespace {

/// Edges count as straight within this fraction of their length, which is round-off of coordinates.
constexpr double straightness = 1e-11;

/// Number of straight pieces per curved edge. Errors of the coupling fall with its fourth power:
/// with 4 pieces, the nodal loads of a uniform pressure between flat rings of 8 quad8 per quarter
/// have errors of 1e-4 of a face, with 2 pieces 2e-3.
constexpr int splits = 4;

Facet makeFacet(const Face& face, std::vector<Reference> reference, bool whole) {
  if (face.sign < 0) std::reverse(reference.begin(), reference.end());
  Facet facet{{}, std::move(reference), whole};
  for (const Reference& corner : facet.reference)
    facet.corners.push_back(facePoint(face, corner).position);
  return facet;
}

bool hasStraightEdges(const Face& face, const FaceType& type, const Point& direction) {
  return std::ranges::all_of(type.edges, [&](const MidEdge& edge) {
    const auto [a, b] = edge.corners;
    const Point chord = minus(face.points[b], face.points[a]),
                half = minus(face.points[edge.node], face.points[a]);
    return std::abs(dot(cross(half, chord), direction)) <= straightness * dot(chord, chord);
  });
}

/// Returns the corners of the equal triangles into which a triangle or a square is split, `splits`
/// along each edge.
std::vector<std::vector<Reference>> triangles(const FaceType& type) {
  const bool triangle = type.corners == 3;
  const double low = triangle ? 0 : -1, high = 1;
  const auto at = [&](int i, int j) {
    return Reference{low + (high - low) * i / splits, low + (high - low) * j / splits};
  };
  std::vector<std::vector<Reference>> parts;
  for (int j = 0; j < splits; ++j)
    for (int i = 0; i < (triangle ? splits - j : splits); ++i) {
      parts.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (!triangle || i + j + 1 < splits)
        parts.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return parts;
}

/// Returns twice the area of the projection of a facet, with the sign of its order.
double projectedArea(const Facet& facet, const Point& a, const Point& direction) {
  double twice = 0;
  for (std::size_t i = 2; i < facet.corners.size(); ++i)
    twice += dot(cross(minus(facet.corners[i - 1], a), minus(facet.corners[i], a)), direction);
  return twice;
}

/// Returns true if the projection is convex, seen from either side.
bool isConvexAlong(const Facet& facet, const Point& direction) {
  const std::size_t n = facet.corners.size();
  const double side = projectedArea(facet, facet.corners[0], direction);
  for (std::size_t i = 0; i < n; ++i) {
    const Point &a = facet.corners[i], &b = facet.corners[(i + 1) % n],
                &c = facet.corners[(i + 2) % n];
    if (!(dot(cross(minus(b, a), minus(c, b)), direction) * side > 0)) return false;
  }
  return true;
}

}  // namespace

Point Facet::centre() const {
  Point sum{};
  for (const Point& corner : corners) sum = plus(sum, corner);
  return scaled(sum, 1. / corners.size());
}

Point Facet::normal() const {
  if (corners.size() == 2) return unit(cross(minus(corners[1], corners[0]), {0, 0, 1}));
  Point sum{};  // the vector area, which treats all corners equally
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum = plus(sum, cross(minus(corners[i - 1], corners[0]), minus(corners[i], corners[0])));
  return unit(sum);
}

Facet wholeFacet(const Face& face) {
  const FaceType& type = faceType(face.type);
  return makeFacet(face, {type.reference.begin(), type.reference.begin() + type.corners}, true);
}

std::vector<Facet> facets(const Face& face, const Point& direction) {
  const FaceType& type = faceType(face.type);
  const Facet whole = wholeFacet(face);
  if (type.dimension == 1 || type.nodes == 3) return {whole};
  if (hasStraightEdges(face, type, direction) && isConvexAlong(whole, direction)) return {whole};
  std::vector<Facet> parts;
  for (const auto& reference : triangles(type)) parts.push_back(makeFacet(face, reference, false));
  return parts;
}

double sag(const Face& face, const Facet& facet, const Point& direction) {
  double largest = 0;
  const std::size_t n = facet.whole ? 0 : facet.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const Reference &a = facet.reference[i], &b = facet.reference[next];
    const Point middle = facePoint(face, Reference{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}).position,
                chord = minus(facet.corners[next], facet.corners[i]),
                half = minus(middle, facet.corners[i]);
    largest = std::max(largest, std::abs(dot(cross(half, chord), direction)) / length(chord));
  }
  return largest;
}

Frame::Frame(const Facet& facet) : origin_(facet.centre()), normal_(facet.normal()) {
  const Point edge = minus(facet.corners[1], facet.corners[0]);
  along_ = unit(plus(edge, normal_, -dot(edge, normal_)));
  across_ = cross(normal_, along_);
}

PlanePoint Frame::flat(const Point& x) const {
  const Point offset = minus(x, origin_);
  return {dot(offset, along_), dot(offset, across_)};
}

Point Frame::lifted(const PlanePoint& y) const {
  return plus(plus(origin_, along_, y[0]), across_, y[1]);
}

Region Frame::flat(const Facet& facet) const {
  Region region;
  for (const Point& corner : facet.corners) region.push_back(flat(corner));
  return region;
}

HalfPlane Frame::distanceTo(const Facet& facet) const {
  // (origin + y_1 along + y_2 across + g normal − centre)·m = 0
  const Point m = facet.normal();
  const double slope = dot(normal_, m);
  return {{-dot(along_, m) / slope, -dot(across_, m) / slope},
          dot(minus(facet.centre(), origin_), m) / slope};
}

}  // namespace squeal::mortar
