// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Integrals of products of the shape functions of a slave face and of its masters. All terms of
/// the coupling are linear in these integrals for any basis and pivots, so the integration points
/// need not be stored.
#include <functional>
#include <span>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "model/mortar/overlap.hpp"

namespace squeal::mortar {

/// The integrals against the shape functions φ_l of one master face.
struct MasterMoments {
  std::size_t face;  ///< index into the master faces
  /// ∫ φ_i φ_l dA, [node][node of the master face], m² (m in plane problems)
  linalg::DenseMatrix values;
  /// ∫ φ_i V·∇_S φ_l dA with the velocity V, [node][node of the master face], m²/s (m/s); empty
  /// without a velocity
  linalg::DenseMatrix convected;
};

/// The integrals over the covered part of a slave face, with its shape functions φ_i.
struct FaceMoments {
  int type = 0;                    ///< gmsh element type of the slave face
  std::vector<double> value, gap;  ///< ∫ φ_i dA, ∫ φ_i gap dA, [node], m² (m), m³ (m²)
  std::vector<Point> normal;       ///< ∫ φ_i n dA, [node]; n points out of the slave
  linalg::DenseMatrix products;    ///< ∫ φ_i φ_j dA, [node][node]
  std::vector<MasterMoments> masters;
  double covered = 0, largestGap = 0;  ///< area, m² (m); largest |gap|, m
  /// The integration points, at which dual functions must not be large. May be cleared for a fully
  /// covered face, where they are never large.
  std::vector<Reference> points;
};

/// Returns the velocity at a point of a master face, m/s.
using Velocity = std::function<Point(std::size_t masterFace, const Point& x)>;

/// Integrates over the covered part of a slave face, with the `points` of overlap(). An empty
/// `velocity` omits the convected terms. Not collective.
FaceMoments moments(const Face& slave, std::span<const Face* const> masters,
                    std::span<const OverlapPoint> points, const Velocity& velocity = {});

}  // namespace squeal::mortar
