// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Operations on convex regions of a plane, which are polygons or segments of a line. Not
/// collective.
#include <array>
#include <vector>

namespace squeal::mortar {

using PlanePoint = std::array<double, 2>;
/// The vertices of a convex region, anticlockwise. Two vertices form a segment.
using Region = std::vector<PlanePoint>;

/// The half-plane normal·y + offset ≥ 0.
struct HalfPlane {
  PlanePoint normal;
  double offset;
  double operator()(const PlanePoint& y) const {
    return normal[0] * y[0] + normal[1] * y[1] + offset;
  }
};

/// Returns the area of a polygon, or the length of a segment; 0 for fewer than two vertices.
double measure(const Region& region);
PlanePoint centroid(const Region& region);
/// Returns true for convex polygons, and for segments.
bool isConvex(const Region& region);
/// Returns the part of a region in the half-plane.
Region clip(const Region& region, const HalfPlane& half);
/// Returns the part of a region inside another one, both polygons or both segments of one line. The
/// sides of the other region are first moved outwards by `margin`.
Region intersection(const Region& region, const Region& other, double margin = 0);
/// Returns the part of a region outside another one, in convex pieces. Omits pieces whose measure
/// is at most `smallest`.
std::vector<Region> difference(const Region& region, const Region& other, double smallest);

/// A point of a quadrature rule and its weight, which has the unit of the area of the region (for a
/// segment, of its length).
struct WeightedPoint {
  PlanePoint point;
  double weight;
};

/// Returns a rule that integrates polynomials of this degree over the region exactly.
std::vector<WeightedPoint> quadrature(const Region& region, int degree);

}  // namespace squeal::mortar
