// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Norms of the matrices at the points of a sweep.
#include <utility>
#include <vector>

#include "base/checkpoint/archive.hpp"
#include "eigen/reduction/point_state.hpp"

namespace squeal::reduction {

/// Computes norms and stores them, since each takes many products with large matrices.
class PointNorms {
 public:
  /// Collective. Computes the norms of a point.
  const Norms& compute(const PointProblem& point);
  /// Collective. Returns the norms of the computed point whose friction is nearest and whose other
  /// parameters are the same. If none exists, computes the norms of this point.
  const Norms& nearby(const PointProblem& point);
  /// Not collective. Writes or reads all norms.
  void serialise(checkpoint::Archive& archive) { archive.common(known_); }

 private:
  std::vector<std::pair<sweep::Parameters, Norms>> known_;
};

}  // namespace squeal::reduction
