// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The norms of the matrices of the points of a sweep.
#include <utility>
#include <vector>

#include "base/checkpoint/archive.hpp"
#include "eigen/reduction/point_state.hpp"

namespace squeal::reduction {

/// PointNorms computes norms, which takes many products with large matrices, and keeps them.
class PointNorms {
 public:
  /// Collective. Computes the norms of a point.
  const Norms& compute(const PointProblem& point);
  /// Collective. Returns the norms of the point nearest in friction that has been computed with the
  /// same other parameters. If there is none, the norms of this point are computed.
  const Norms& nearby(const PointProblem& point);
  /// Not collective. Writes all norms, or sets them.
  void exchange(checkpoint::Archive& archive) { archive.common(known_); }

 private:
  std::vector<std::pair<sweep::Parameters, Norms>> known_;
};

}  // namespace squeal::reduction
