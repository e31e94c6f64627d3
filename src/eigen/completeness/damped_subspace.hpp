// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The part of the basis V in which the proof for a point works. Not collective.
#include "eigen/completeness/damped_bounds.hpp"

namespace squeal::completeness {

/// A part of the space of V.
struct Subspace {
  linalg::DenseMatrix vectors;  ///< W; the columns of V W are orthonormal in energy
  double jumpsLeft = 0;         ///< bound of ‖J‖ on the other part
};

/// Returns the space of the constraint modes, the free modes, the responses to the jumps (rows of
/// J V), and the vectors and the other responses of the point.
Subspace subspace(const DampedSet& set, const linalg::DenseMatrix& jumps, const DampedPoint& point);

}  // namespace squeal::completeness
