// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Error estimates for the eigenvalues of the reduced problem as approximations of the full one.
#include <vector>

#include "base/checkpoint/archive.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/reduction/projected_basis.hpp"
#include "eigen/reduction/settings.hpp"

namespace squeal::reduction {

/// Estimates |δs|/|s| by [M.36] from sketches of residuals. The ratio of the norms of K0⁻¹ and
/// diag(K0)⁻¹, computed from residuals that are solved for, converts the latter norm into the
/// former.
class ErrorEstimator {
 public:
  /// A backward error below this is round-off and needs no correction.
  static constexpr double rounding = 1e-14;
  /// Borrows the basis during the lifetime of the object. `frequencies` belong to the free modes
  /// that start it, rad/s, ascending.
  ErrorEstimator(ProjectedBasis& basis, const std::vector<double>& frequencies,
                 const Settings& settings);
  /// Makes errorRatio() return zero, for a basis that is never corrected.
  void acceptAll() { acceptsAll_ = true; }
  /// Records that the basis no longer contains the modes.
  void dropModes() { highestMode_ = 0; }
  /// Records a correction by residuals, whose ratio of norms the basis provides.
  void recordCorrection();

  /// Not collective. Sets the errors of the pairs of a point, whose projected problem is `problem`.
  void estimate(PointState& state, const linalg::DenseProblem& problem) const;
  /// Returns the estimate of |δs|, 1/s.
  double absoluteError(const PointSolution& solution, std::size_t pair) const;
  /// Returns true if the error is within the tolerance. If s is zero within its error, the error is
  /// relative to the lowest free mode: in s itself, or in s² for a problem in s².
  bool isExactEnough(const PointSolution& solution, const pencil::Eigenvalue& e) const;
  /// Returns the ratio of the errors of a pair to the tolerances. It is 0 if only round-off
  /// remains.
  double errorRatio(const PointSolution& solution, std::size_t pair) const;
  /// Returns true if all errors of the point are within the tolerances.
  bool isAccurate(const PointSolution& solution) const;
  /// Collective. Solves for the residuals of the pair with the largest estimate of all points so
  /// far. If this shows that the estimates are too small, returns the points that are no longer
  /// accurate.
  std::vector<PointState*> unconfirmed(std::vector<PointState>& states);
  /// Not collective. Writes or reads the ratios.
  void serialise(checkpoint::Archive& archive);

 private:
  double basisError(const PointSolution& solution, std::size_t pair) const;
  double residualRatio(const PointState& state, const linalg::DensePair& pair,
                       const linalg::Block& columns, pencil::Side side) const;
  void measureRatios(PointState& state, std::size_t pair);

  ProjectedBasis& basis_;
  const Settings settings_;
  bool acceptsAll_ = false;
  double lowestMode_ = 0, highestMode_ = 0;  // rad/s
  double rightRatio_ = 1, leftRatio_ = 1;    // Basis::energyRatios of the residuals
  double measuredRatio_ = 0;                 // of the right residuals that a solve has checked
  double confirmed_ = 0;                     // the largest estimate that a solve has checked
};

}  // namespace squeal::reduction
