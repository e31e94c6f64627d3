// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Corrections of the basis by static responses to friction and to residuals.
#include <vector>

#include "eigen/reduction/error_estimator.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/reduction/projected_basis.hpp"

namespace squeal::reduction {

/// Pairs of a point whose residuals need a correction.
struct CorrectionRequest {
  const PointState* state;
  PointPairs pairs;
  std::vector<double> weights;  ///< [pair] length to which the pair's residual is scaled
};

/// Adds the static responses K0⁻¹ f of forces f to the basis, by block solves.
class Corrector {
 public:
  /// Borrows both arguments during the lifetime of the object.
  Corrector(ProjectedBasis& basis, ErrorEstimator& estimator)
      : basis_(basis), estimator_(estimator) {}
  /// Collective. Adds the static responses to the forces of friction, and of the other terms of
  /// this point only, on the free modes with these frequencies, rad/s [M.29].
  void start(const PointProblem& point, const std::vector<double>& frequencies);
  /// Not collective. Returns the unconverged pairs of a point, except mirror images −s̄. If the
  /// error of a pair is r > 1 times its limit, the correction may leave out 3 % or 1/(√2 r) of its
  /// residual, whichever is more; its weight says so. In the second case half of the squared limit
  /// remains for the error of the correction itself.
  CorrectionRequest requestOf(const PointState& state) const;
  /// Collective. Adds corrections for these residuals, less their part along V. If they have hardly
  /// any other part, since the reduced problem is not solved accurately, the whole residuals are
  /// corrected. Returns the number of vectors added; 0 if the residuals are round-off.
  PetscInt correct(const std::vector<CorrectionRequest>& requests);

 private:
  linalg::Block directions(const std::vector<CorrectionRequest>& requests,
                           ProjectedBasis::Residual kind) const;

  ProjectedBasis& basis_;
  ErrorEstimator& estimator_;
};

}  // namespace squeal::reduction
