// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Proper orthogonal decomposition: the basis is reduced to the principal directions of the
/// eigenvectors of the sweep.
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/reduction/projected_basis.hpp"

namespace squeal::reduction {

/// The eigenvectors of the points solved so far.
class Pod {
 public:
  /// Not collective. Moves the pairs out of these points, and drops their coordinates along
  /// constraint modes.
  void take(std::vector<PointState>& states);
  /// Collective. Replaces the basis, except its constraint modes, by orthonormal combinations of
  /// its vectors. They span the real and imaginary parts of all right vectors except for components
  /// of length 1e-9, which corrections restore. Returns false if there are no pairs. Throws Error
  /// if LAPACK fails.
  bool compress(ProjectedBasis& basis);

 private:
  std::vector<std::vector<linalg::DensePair>> solved_;  // [point]
};

}  // namespace squeal::reduction
