#pragma once
/// This file holds the algebra of points and vectors in space.
#include <cmath>

#include "mesh/mesh.hpp"

namespace squeal::mesh {

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }
/// Returns a + factor · b.
inline Point plus(const Point& a, const Point& b, double factor = 1) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
inline Point minus(const Point& a, const Point& b) { return plus(a, b, -1); }
inline Point scaled(const Point& a, double factor) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
inline Point unit(const Point& a) { return scaled(a, 1 / length(a)); }
/// Returns a − (a·n) n, the part of a along the plane whose unit normal is n.
inline Point tangential(const Point& a, const Point& n) { return plus(a, n, -dot(a, n)); }

}  // namespace squeal::mesh
