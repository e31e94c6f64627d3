// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The part of the basis V on which the proof for a point is carried out. Not collective.
#include "eigen/completeness/damped_bounds.hpp"

namespace squeal::completeness {

/// A part of the space of V.
struct Subspace {
  linalg::DenseMatrix vectors;  ///< W; the columns of V W are orthonormal in energy
  double jumpsLeft = 0;         ///< bound of ‖J‖ on the other part
};

/// Returns the span of the constraint modes, the free modes, the responses to forces at the jumps,
/// DampedPoint::vectors, and the responses to DampedPoint::forces. `jumps` contains the rows of J V
/// that Φ or B use.
Subspace subspace(const DampedSet& set, const linalg::DenseMatrix& jumps, const DampedPoint& point);

}  // namespace squeal::completeness
