#pragma once
/// These functions map reference to physical coordinates of one element; the element routines share
/// them.
#include <array>
#include <vector>

#include "elasticity/element.hpp"

namespace squeal::elasticity {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Returns the Jacobian
///   J[r][d] = ∂x_d/∂ξ_r.
/// Rows beyond the element's dimension are unit vectors, so that the inverse exists.
inline Matrix3 jacobian(const double* gradient, const std::vector<Point>& nodes, int dimension) {
  Matrix3 j{};
  for (int r = dimension; r < 3; ++r) j[r][r] = 1;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int r = 0; r < dimension; ++r)
      for (std::size_t d = 0; d < 3; ++d) j[r][d] += gradient[3 * i + r] * nodes[i][d];
  return j;
}

inline double determinant(const Matrix3& j) {
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

inline Matrix3 inverse(const Matrix3& j, double det) {
  Matrix3 inv;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const std::size_t p = (b + 1) % 3, q = (b + 2) % 3, r = (a + 1) % 3, s = (a + 2) % 3;
      inv[a][b] = (j[p][r] * j[q][s] - j[p][s] * j[q][r]) / det;
    }
  return inv;
}

/// Returns det J. Throws InvertedElement unless it is positive.
inline double positiveDeterminant(const Matrix3& j) {
  const double det = determinant(j);
  if (!(det > 0)) throw InvertedElement{};
  return det;
}

/// Returns ∂φ/∂x from the reference gradient ∂φ/∂ξ and J⁻¹.
inline Point mapped(const Matrix3& inv, const Point& reference) {
  Point g{};
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t r = 0; r < 3; ++r) g[d] += inv[d][r] * reference[r];
  return g;
}

}  // namespace squeal::elasticity
