// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Error estimates for the eigenvalues of the reduced problem as approximations of the eigenvalues
/// of the full problem. Numbers in brackets refer to equations in docs/method.md, section 11.
#include <vector>

#include "base/checkpoint/archive.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/reduction/projected_basis.hpp"
#include "eigen/reduction/settings.hpp"

namespace squeal::reduction {

/// Estimates the relative error |δs|/|s| of an eigenvalue s by [M.36]. The estimate needs the norm
/// √(rᵀ K0⁻¹ r) of the residual, which takes a solve with K0. A sketch, that is, the products of
/// the residual with a few random vectors [M.39], gives the norm √(rᵀ diag(K0)⁻¹ r) cheaply. The
/// estimator measures the ratio of the two norms for a few residuals by solving with K0. It
/// multiplies the cheap norm by the largest of these ratios.
class ErrorEstimator {
 public:
  /// Borrows the basis during the lifetime of the object. `frequencies` are those of the free modes
  /// in the basis, rad/s, ascending.
  ErrorEstimator(ProjectedBasis& basis, const std::vector<double>& frequencies,
                 const Settings& settings);
  /// Makes errorRatio() return zero, for a basis that the program never corrects.
  void acceptAll() { acceptsAll_ = true; }
  /// Records that the basis no longer contains the free modes. The estimates then use only the
  /// right residuals.
  void dropModes() { highestMode_ = 0; }
  /// Records the ratio of the two norms for the residuals whose corrections were last added to the
  /// basis.
  void recordCorrection();

  /// Not collective. Sets the errors of the eigenpairs of a point of the sweep. `problem` is the
  /// problem projected on the basis at that point.
  void estimate(PointState& state, const linalg::DenseProblem& problem) const;
  /// Returns the estimate of |δs|, 1/s.
  double absoluteError(const PointSolution& solution, std::size_t pair) const;
  /// Returns true if the relative error |δs|/|s| of the eigenvalue is within the tolerance. If s is
  /// zero within its error, |δs|/ω_1 is used instead, where ω_1 is the lowest angular frequency of
  /// the free modes. This ratio is squared if the problem has a pencil::Symmetry.
  bool isExactEnough(const PointSolution& solution, const pencil::Eigenvalue& e) const;
  /// Returns the larger of two ratios: the backward error and the error due to the basis, each
  /// divided by its limit. The limit of the latter is what the error of the dense solve leaves of
  /// the tolerance, at least a tenth; if nothing is left, the whole tolerance. Returns 0 if the
  /// residual is only round-off.
  double errorRatio(const PointSolution& solution, std::size_t pair) const;
  /// Returns true if all errors of the point are within their limits.
  bool isAccurate(const PointSolution& solution) const;
  /// Collective. Measures the ratio of the norms for the residuals of the eigenpair with the
  /// largest estimate. If this raises the largest ratio, all estimates grow. Returns the points
  /// that are not accurate afterwards; none if no estimate exceeds the largest one checked before.
  std::vector<PointState*> unconfirmed(std::vector<PointState>& states);
  /// Not collective. Writes or reads the ratios, the largest checked estimate and the frequencies.
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
  double rightRatio_ = 1, leftRatio_ = 1;    // ratios of norms of right and left residuals
  double measuredRatio_ = 0;                 // largest right ratio that unconfirmed() has measured
  double confirmed_ = 0;                     // largest estimate that unconfirmed() has checked
};

}  // namespace squeal::reduction
