// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Algebra of points, vectors and small matrices in space.
#include <array>
#include <cmath>

#include "model/mesh/mesh.hpp"

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
/// Returns a − (a·n) n, the component of a in the plane whose unit normal is n.
inline Point tangential(const Point& a, const Point& n) { return plus(a, n, -dot(a, n)); }

/// Returns a unit vector perpendicular to a unit vector.
inline Point across(const Point& e) {
  std::size_t least = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::abs(e[d]) < std::abs(e[least])) least = d;
  Point other{};
  other[least] = 1;
  return unit(cross(e, other));
}

/// Returns the unit vector along x, y or z.
inline Point axis(int component) {
  Point e{};
  e[component] = 1;
  return e;
}

/// A matrix, stored by rows.
using Matrix3 = std::array<std::array<double, 3>, 3>;
inline constexpr Matrix3 identity3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
/// Returns the vector with these components along the axes, which are the rows of `axes`.
inline Point along(const Matrix3& axes, const Point& components) {
  Point sum{};
  for (std::size_t k = 0; k < 3; ++k) sum = plus(sum, axes[k], components[k]);
  return sum;
}
/// Returns the product a b.
inline Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}
inline double determinant(const Matrix3& j) {
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

/// Returns the inverse of a matrix with the determinant `det`.
inline Matrix3 inverse(const Matrix3& j, double det) {
  Matrix3 inv;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const std::size_t p = (b + 1) % 3, q = (b + 2) % 3, r = (a + 1) % 3, s = (a + 2) % 3;
      inv[a][b] = (j[p][r] * j[q][s] - j[p][s] * j[q][r]) / det;
    }
  return inv;
}

}  // namespace squeal::mesh
