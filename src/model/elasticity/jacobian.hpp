// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The map from reference to physical coordinates of one element, for the element routines.
#include <array>
#include <vector>

#include "model/elasticity/element.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::elasticity {

using mesh::determinant;
using mesh::inverse;
using mesh::Matrix3;

/// Returns the Jacobian
///   J[r][d] = ∂x_d/∂ξ_r.
/// Rows beyond the element's dimension are unit vectors, so the inverse exists.
inline Matrix3 jacobian(const double* gradient, const std::vector<Point>& nodes, int dimension) {
  Matrix3 j{};
  for (int r = dimension; r < 3; ++r) j[r][r] = 1;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int r = 0; r < dimension; ++r)
      for (std::size_t d = 0; d < 3; ++d) j[r][d] += gradient[3 * i + r] * nodes[i][d];
  return j;
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
