// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Maps between the reference coordinates of a face and space. Not collective.
#include "model/mortar/basis.hpp"
#include "model/mortar/face.hpp"

namespace squeal::mortar {

/// A point of a face.
struct FacePoint {
  Point position{};                ///< m
  std::array<Point, 2> tangent{};  ///< ∂x/∂ξ, m; the second one of a line is the unit vector of z
  /// Normal out of the body. Its length is the area (the length in the plane) per unit of the
  /// reference coordinates, m² (m).
  Point normal{};
};

FacePoint facePoint(const Face& face, const FaceShape& shape);
inline FacePoint facePoint(const Face& face, const Reference& at) {
  return facePoint(face, faceShape(faceType(face.type), at));
}

/// The point where a straight line meets a face.
struct Foot {
  Reference reference{};
  double distance = 0;  ///< from the start of the line along its direction, m
  /// False if the line misses the face, or passes it at more than a quarter of its size. Then
  /// `reference` is a point on the rim, and `distance` belongs to its foot on the line.
  bool met = true;
};

/// Returns the point where the line through `from` along the unit vector `direction` meets the
/// face,
///   x(ξ) = from + distance · direction,
/// within round-off. Points outside the face count up to a quarter of its size, since
/// straight-edged cells end before a curved rim.
Foot project(const Face& face, const Point& from, const Point& direction);
/// The same for a point that is known to be near `start`.
Foot project(const Face& face, const Point& from, const Point& direction, const Reference& start);

/// Returns Σ V_S · ∇_S φ_i, the derivative of each shape function along a velocity, 1/s for m/s;
/// only the tangential part of the velocity counts.
NodeValues derivativeAlong(const FacePoint& point, const FaceShape& shape, const Point& velocity);

}  // namespace squeal::mortar
