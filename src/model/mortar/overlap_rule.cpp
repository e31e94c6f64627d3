// SPDX-License-Identifier: BSD-2-Clause
#include "model/mortar/overlap_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>

#include "model/mesh/vector.hpp"
#include "model/mortar/surface.hpp"

namespace squeal::mortar {

using mesh::dot;

namespace {

/// The largest estimated error of integrals over flat faces with straight edges, relative to a
/// face; tests of all face types show errors below a thousandth of it.
constexpr double estimatedError = 1e-10;
/// Upper bound of the considered spread of the Jacobian over one triangle, which needs the degree
/// 69.
constexpr double worstSpread = 0.7;

/// Returns the degree of the rule for products of shape functions of both faces, increased for
/// faces that are not affine, where these are not polynomials. On parts of split faces the
/// functions are nearly polynomials of their order, and the area of a flat face has the degree 6.
int degree(const FaceType& slave, const FaceType& master, bool whole) {
  const int order = std::max(slave.order, master.order);
  const bool triangles = slave.corners == 3 && master.corners == 3;
  return 2 * (triangles || !whole ? order : 2 * order) + 2;
}

/// Returns (largest − smallest) / (largest + smallest) of the values, or 1 if their signs differ.
double spread(std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax(values);
  return low * high > 0 ? (high - low) / std::abs(high + low) : 1;
}

/// Returns the area of the projection per unit of the reference coordinates.
double projectedJacobian(const Face& face, const Reference& at, const Point& direction) {
  return dot(facePoint(face, at).normal, direction);
}

/// Returns true if the reference coordinates of a face are linear in the projection. Otherwise
/// shape functions are not polynomials there.
bool isAffine(const Face& face, const Point& direction) {
  std::vector<double> jacobian;
  for (const Reference& node : faceType(face.type).reference)
    jacobian.push_back(projectedJacobian(face, node, direction));
  return spread(jacobian) < 1e-6;  // its square is below round-off
}

/// Returns the degree that integrates shape functions of a face over a triangle of the projection
/// with the estimated error.
///
/// Let J be the Jacobian and κ its spread over the triangle. On a line, the inverse of x = ξ + κ
/// ξ²/2 is a square root that is singular at x = −1/(2κ). This point is on the Bernstein ellipse
/// whose axes add up to 1/κ times the length, so the error of a rule of degree d falls like κ^d.
int degreeOverTriangle(const Face& face, const Frame& frame, const Region& triangle) {
  std::array<double, 6> jacobian;
  for (std::size_t i = 0; i < 3; ++i) {
    const PlanePoint &a = triangle[i], &b = triangle[(i + 1) % 3],
                     middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    const auto at = [&](const PlanePoint& y) {
      return projectedJacobian(face, project(face, frame.lifted(y), frame.normal()).reference,
                               frame.normal());
    };
    jacobian[2 * i] = at(a), jacobian[2 * i + 1] = at(middle);
  }
  const int polynomial = 2 * faceType(face.type).order;
  const double kappa = std::clamp(spread(jacobian), 1e-6, worstSpread);
  return polynomial + int(std::ceil(std::log(estimatedError) / std::log(kappa)));
}

}  // namespace

std::vector<WeightedPoint> overlapRule(const Region& tile, const Frame& frame, const Face& slave,
                                       const Face& master, bool whole) {
  const int least = degree(faceType(slave.type), faceType(master.type), whole);
  std::vector<const Face*> distorted;
  if (whole && tile.size() > 2)
    for (const Face* face : {&slave, &master})
      if (!isAffine(*face, frame.normal())) distorted.push_back(face);
  if (distorted.empty()) return quadrature(tile, least);
  std::vector<WeightedPoint> points;
  for (std::size_t i = 2; i < tile.size(); ++i) {
    const Region triangle{tile[0], tile[i - 1], tile[i]};
    int needed = least;
    for (const Face* face : distorted)
      needed = std::max(needed, degreeOverTriangle(*face, frame, triangle));
    std::ranges::move(quadrature(triangle, needed), std::back_inserter(points));
  }
  return points;
}

}  // namespace squeal::mortar
