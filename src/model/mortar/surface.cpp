// SPDX-License-Identifier: BSD-2-Clause
#include "model/mortar/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include "model/mesh/vector.hpp"

namespace squeal::mortar {

using mesh::cross;
using mesh::dot;
using mesh::length;
using mesh::minus;
using mesh::plus;
using mesh::scaled;

namespace {

/// The largest distance outside the face at which a line may meet it, relative to the reference
/// cell.
constexpr double margin = 0.25;
constexpr int mostSteps = 50;

/// Returns a point of the reference cell, enlarged by `extra` of its size, that is nearest, or
/// close to nearest, to a given point.
Reference clamped(const FaceType& type, const Reference& x, double extra) {
  if (type.dimension == 1) return {std::clamp(x[0], -1 - 2 * extra, 1 + 2 * extra), 0};
  if (type.corners == 4)
    return {std::clamp(x[0], -1 - 2 * extra, 1 + 2 * extra),
            std::clamp(x[1], -1 - 2 * extra, 1 + 2 * extra)};
  Reference y{std::max(x[0], -extra), std::max(x[1], -extra)};
  const double beyond = y[0] + y[1] - 1 - extra;
  if (beyond > 0) {
    y = {y[0] - beyond / 2, y[1] - beyond / 2};
    for (std::size_t d = 0; d < 2; ++d)
      if (y[d] < -extra) y[d] = -extra, y[1 - d] = 1 + 2 * extra;
  }
  return y;
}

/// Returns x with x[0] a + x[1] b + x[2] c = right, by Cramer's rule; not finite if the vectors are
/// linearly dependent.
Point solve(const Point& a, const Point& b, const Point& c, const Point& right) {
  const double det = dot(a, cross(b, c));
  return {dot(right, cross(b, c)) / det, dot(a, cross(right, c)) / det,
          dot(a, cross(b, right)) / det};
}

double largest(const Reference& x) { return std::max(std::abs(x[0]), std::abs(x[1])); }

/// Newton's method on x(ξ) − from − g n = 0, for ξ and g together. Steps stay within twice the
/// margin, so the iteration cannot diverge on a distorted face. Returns false if it does not
/// converge within the margin.
bool newton(const Face& face, const FaceType& type, const Point& from, const Point& direction,
            Foot& at) {
  for (int step = 0; step < mostSteps; ++step) {
    const auto point = facePoint(face, faceShape(type, at.reference));
    const Point offset = minus(point.position, from);
    const Point change = solve(point.tangent[0], point.tangent[1], direction, offset);
    if (!std::isfinite(change[0] + change[1] + change[2])) return false;
    at.distance = change[2];
    const Reference before = at.reference;
    const Reference wanted{before[0] - change[0], type.dimension == 1 ? 0 : before[1] - change[1]};
    at.reference = clamped(type, wanted, 2 * margin);
    const double moved = largest({at.reference[0] - before[0], at.reference[1] - before[1]});
    // Convergence is quadratic: after a step this small only round-off remains.
    const double size = largest({change[0], change[1]});
    if (size < 1e-8) {
      const Reference inside = clamped(type, at.reference, margin);
      return largest({inside[0] - at.reference[0], inside[1] - at.reference[1]}) < 1e-9;
    }
    if (moved == 0) return false;  // stopped by the limit
  }
  return false;
}

}  // namespace

FacePoint facePoint(const Face& face, const FaceShape& shape) {
  FacePoint point;
  for (std::size_t i = 0; i < face.points.size(); ++i) {
    const Point& x = face.points[i];
    for (std::size_t d = 0; d < 3; ++d) {
      point.position[d] += shape.value[i] * x[d];
      point.tangent[0][d] += shape.gradient[i][0] * x[d];
      point.tangent[1][d] += shape.gradient[i][1] * x[d];
    }
  }
  if (faceType(face.type).dimension == 1) point.tangent[1] = {0, 0, 1};
  point.normal = scaled(cross(point.tangent[0], point.tangent[1]), face.sign);
  return point;
}

Foot project(const Face& face, const Point& from, const Point& direction) {
  return project(face, from, direction, faceType(face.type).centre());
}

Foot project(const Face& face, const Point& from, const Point& direction, const Reference& start) {
  const FaceType& type = faceType(face.type);
  Foot at{start};
  if (newton(face, type, from, direction, at)) return at;
  // Other starts, for strongly curved faces: the centre and the nodes.
  at = {type.centre()};
  if (newton(face, type, from, direction, at)) return at;
  Foot nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Reference& node : type.reference) {
    at = {node};
    if (newton(face, type, from, direction, at)) return at;
    const Reference rim = clamped(type, at.reference, 0);
    const Point offset = minus(facePoint(face, rim).position, from);
    const double along = dot(offset, direction), aside = length(plus(offset, direction, -along));
    if (aside < least) {
      least = aside;
      nearest = {rim, along, false};
    }
  }
  return nearest;
}

NodeValues derivativeAlong(const FacePoint& point, const FaceShape& shape, const Point& velocity) {
  // V = c_0 a_0 + c_1 a_1 + normal part,   (V·∇)φ = c_0 ∂φ/∂ξ_0 + c_1 ∂φ/∂ξ_1
  const Point c = solve(point.tangent[0], point.tangent[1], point.normal, velocity);
  NodeValues derivative{};
  for (std::size_t i = 0; i < mostNodes; ++i)
    derivative[i] = c[0] * shape.gradient[i][0] + c[1] * shape.gradient[i][1];
  return derivative;
}

}  // namespace squeal::mortar
