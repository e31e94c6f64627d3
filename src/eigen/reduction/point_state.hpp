// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The points of a batch while the basis is corrected.
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/reduction/projected.hpp"
#include "eigen/reduction/spectrum.hpp"
#include "eigen/subspace/substructure.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::reduction {

/// One point of a sweep.
struct PointProblem {
  sweep::Parameters at;
  /// The terms of all points, the terms of the points with the same boundary unknowns, and the
  /// terms of this point.
  pencil::Pencil pencil;
  int set = 0;  ///< index from ReducedProblem::addSet(); 0: no boundary unknowns
};

/// Points with the same boundary unknowns.
struct PointSet {
  PointSpace space;
  /// Collective. Returns a pencil with the terms of all points and, after them, those of the set.
  std::function<pencil::Pencil()> pencil;
  std::optional<ProjectedTerms> terms;  ///< projected terms of the set; none if not loaded
  std::vector<PetscInt> slidingRows;    ///< of a passed set: its rows of the factored friction
  double top;                           ///< top of the band that is listed, rad/s
  int modesInBand;                      ///< number of free modes up to `top`
};

using Norms = std::array<double, 3>;  ///< 2-norms of K̄, Z̄, M̄ of a point

/// Estimated errors of an eigenpair. The estimate of |δs|/|s| is right · left + dense. `right` and
/// `left` use the norm of diag(K0)⁻¹ instead of K0⁻¹; the estimator multiplies each by its ratio of
/// the two norms, and replaces the second factor by 1 if it exceeds 1.
struct PairErrors {
  double backward = 0;  ///< backward error in the full problem
  double right = 0;     ///< error of the right vector, times the condition number of s
  double left = 0;      ///< error of the left vector; infinite if |s| ≥ ω of the highest mode
  double roundOff = 0;  ///< upper bound of the round-off in yᴴP(s)x of unit vectors
  double dense = 0;     ///< relative error of s due to the dense solve
  bool isRoundOff = false;  ///< the residual is round-off, which no correction can reduce
};

/// The eigenpairs of a point and their errors.
struct PointSolution {
  Norms norms{};
  Spectrum spectrum;
  std::vector<PairErrors> errors;  ///< [pair of the band]
  pencil::Symmetry symmetry = pencil::Symmetry::none;

  /// Moves the pairs of the band with |s| > `top` (rad/s) to the guard zone.
  void truncate(double top);
};

/// A point in the current basis.
struct PointState {
  const PointProblem* point;
  const PointSet* set;
  ProjectedTerms ownTerms;
  bool damped;
  bool associated = false;  ///< true for the problem of the free modes, with only K and M
  PointSolution solution = {};
  PetscInt solvedIn = 0;  ///< size of the basis in which the spectrum was computed

  /// Returns these pairs, borrowed, with their columns. If `isDamped` is false, pairs with real
  /// vectors may take one column.
  PointPairs pairs(std::vector<const linalg::DensePair*> some, bool isDamped) const {
    return {{point->at, associated}, Coordinates(std::move(some), isDamped, set->space)};
  }
};

/// A batch between two rounds of corrections.
struct PendingBatch {
  int round = 0;                         ///< number of the next round
  PetscInt largest = 0;                  ///< basis size at which no further round starts
  std::vector<PointSolution> solutions;  ///< [point]
  std::vector<unsigned char> open;       ///< [point] 1 if it is not accurate yet
};

}  // namespace squeal::reduction
