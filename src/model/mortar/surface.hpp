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
  /// Normal out of the body. Its length is the area per unit of the reference coordinates, m² (in
  /// plane problems the length, m).
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
  /// False if the line misses the face by more than a quarter of the face's size. Then `reference`
  /// is a point of the face near the line, and `distance` is that of the point of the line nearest
  /// to it.
  bool met = true;
};

/// Returns the point where the line through `from` along the unit vector `direction` meets the
/// face,
///   x(ξ) = from + distance · direction,
/// within round-off. Points outside the face are accepted up to a quarter of its size, since cells
/// with straight edges end short of a curved rim.
Foot project(const Face& face, const Point& from, const Point& direction);
/// Does the same for a point that is known to be near `start`.
Foot project(const Face& face, const Point& from, const Point& direction, const Reference& start);

/// Returns V·∇_S φ_i, the derivative of each shape function along a velocity V, 1/s for V in m/s.
/// Only the tangential part of V has an effect.
NodeValues derivativeAlong(const FacePoint& point, const FaceShape& shape, const Point& velocity);

}  // namespace squeal::mortar
