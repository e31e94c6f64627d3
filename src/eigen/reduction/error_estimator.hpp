// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Estimates of the errors that the reduced problem leaves in the eigenvalues of the full one.
#include <vector>

#include "base/checkpoint/archive.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/reduction/projected_basis.hpp"
#include "eigen/reduction/settings.hpp"

namespace squeal::reduction {

/// An ErrorEstimator estimates |δs|/|s| by [M.36] from sketches of residuals. Their norm of
/// diag(K0)⁻¹ is turned into that of K0⁻¹ by the ratios of the two norms, which are measured for
/// the residuals that are solved for.
class ErrorEstimator {
 public:
  /// A backward error below this is round-off: nothing is left to correct.
  static constexpr double rounding = 1e-14;
  /// Borrows the basis during the life of the object. `frequencies` are those of the free modes
  /// that start it, rad/s, ascending.
  ErrorEstimator(ProjectedBasis& basis, const std::vector<double>& frequencies,
                 const Settings& settings);
  /// Lets errorRatio() be zero, if the basis is never corrected.
  void acceptAll() { acceptsAll_ = true; }
  /// Records that the modes are no longer in the basis.
  void dropModes() { highestMode_ = 0; }
  /// Records that the basis has been corrected by residuals, whose ratio of norms it knows.
  void noteCorrection();

  /// Not collective. Sets the errors of the pairs of a point, whose projected problem is `problem`.
  void estimate(PointState& state, const linalg::DenseProblem& problem) const;
  /// Returns the estimate of |δs|, 1/s.
  double absoluteError(const PointSolution& solution, std::size_t pair) const;
  /// Returns true if the error is within the tolerance. If s is zero within its error, that error
  /// is relative to the lowest free mode: in s itself, or in s² if the problem is one in s².
  bool isExactEnough(const PointSolution& solution, const pencil::Eigenvalue& e) const;
  /// Returns the ratio of the errors of a pair to the tolerances. It is 0 if only round-off is
  /// left.
  double errorRatio(const PointSolution& solution, std::size_t pair) const;
  /// Returns true if all errors of the point are within the tolerances.
  bool isAccurate(const PointSolution& solution) const;
  /// Collective. Solves for the residuals of the pair with the largest estimate of all points so
  /// far. Returns the points that are no longer accurate, if that shows the estimates to be too
  /// small.
  std::vector<PointState*> unconfirmed(std::vector<PointState>& states);
  /// Not collective. Writes the ratios, or sets them.
  void exchange(checkpoint::Archive& archive);

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
  double measuredRatio_ = 0;                 // that of right residuals of pairs solved for
  double confirmed_ = 0;                     // the largest estimate that a solve has been made for
};

}  // namespace squeal::reduction
