// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The reduced problem [4.19] is corrected until its eigenvalues are those of the full one.
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "base/checkpoint/archive.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/band.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/reduction/corrector.hpp"
#include "eigen/reduction/error_estimator.hpp"
#include "eigen/reduction/pod.hpp"
#include "eigen/reduction/point_norms.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/reduction/projected_basis.hpp"
#include "eigen/reduction/settings.hpp"
#include "eigen/reduction/solved_pairs.hpp"
#include "eigen/subspace/mode_count.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::reduction {

/// The answer of the full problem to eigenpairs of the reduced one.
struct Improvement {
  /// True if the basis has grown, or if near() is better: the pairs are then to be solved for
  /// again.
  bool changed = false;
  /// The largest backward error of the pairs in the full problem, [located]; NaN where there is no
  /// problem at this friction. There are no entries if there is no larger problem.
  std::vector<double> backwardError;
  /// Upper bound of the round-off in yᴴP(s)x with unit vectors x and y of the reduced problem,
  /// likewise.
  std::vector<double> roundOff;
};

/// The reduced problem makes Rayleigh–Ritz on the free modes and, unless `-flutter_basis modal`,
/// on static responses to friction forces and to its own residuals. The modes alone miss unstable
/// eigenvalues and invent others. A round adds K0⁻¹ r for the residuals r of all bad pairs, solved
/// for together with the real symmetric factorisation that the modes used, and gains about a
/// decade. A pair is certified if its full-order backward error is at most `-flutter_accuracy` and
/// the estimate of |δs|/|s| at most `-flutter_tolerance`. The basis is kept over a sweep.
class ReducedProblem {
 public:
  /// Collective. Borrows the system, that of the interior unknowns, during the life of the object
  /// and shares the terms of `pencil`, which hold at all points and for all unknowns. `modes` are
  /// M0-orthonormal with ascending frequencies; they are copied.
  ReducedProblem(const pencil::Pencil& pencil, const factor::AssociatedSystem& system,
                 const modes::Modes& modes, const Settings& settings,
                 Substructure substructure = {});
  /// Collective. Makes known the points that have the boundary unknowns with has[boundary unknown
  /// of all ranks] set, and returns the number of this set. Of `pencil`, the terms that follow
  /// those of the constructor and hold for all parameters hold for these points; they are shared.
  /// Throws Error if their stiffness is not positive definite.
  int addSet(const pencil::Pencil& pencil, const std::vector<unsigned char>& has);
  /// Collective. Returns the free modes in the band of a set, corrected as eigenvalues are. Their
  /// vectors have the entries of all unknowns. Of `pencil`, K and M alone count. Their number is
  /// confirmed where that of the interior is and the bounds of ModeCount agree. From then on, what
  /// solve() lists at the points of the set ends where these modes place the top of the band, so
  /// that it does not depend on the sets that share the basis.
  modes::Modes freeModes(int set, const pencil::Pencil& pencil);
  /// Collective. Solves all points at once and returns their complex modes, [point]: their dense
  /// problems are spread over the ranks, and their corrections are solved for together. The static
  /// responses are those of the first point of the first batch. Shapes are mapped to nodal
  /// displacements by `trial` (T, N×n).
  std::vector<pencil::ComplexModes> solve(const std::vector<PointProblem>& batch, Mat trial);
  /// Returns true if vectors are only added to the basis, so that exchange() can be called.
  bool grows() const { return !settings_.compressed; }
  /// Lets solve() call `action`, which is collective, whenever the basis has grown.
  void afterEachRound(std::function<void()> action) { afterRound_ = std::move(action); }
  /// Collective. Writes what has been found since the last call, and the state of the batch that
  /// solve() has in hand, or takes both up again; the next solve() must then be of that batch. All
  /// sets must be known. While it is written from, the archive borrows the basis.
  void exchange(checkpoint::Archive& archive);
  /// Collective. Returns the eigenpairs of a point of these parameters and boundary unknowns that
  /// the band watches, with both vectors, in coordinates of the basis of the time when it was
  /// solved: those in the band as solve() left them, those around it as exact as they were needed.
  /// Returns none where the point has not been solved, or where there was no memory to keep them.
  std::optional<std::vector<linalg::DensePair>> watchedPairs(const sweep::Parameters& at,
                                                             int set) const {
    return solved_.at(at, set);
  }
  /// Collective. Returns the projection of the problem at this point on the basis as it is.
  linalg::DenseProblem project(const PointProblem& point) const;
  /// Collective. Returns the same with all boundary unknowns, in coordinates that all points share.
  linalg::DenseProblem projectOnAll(const PointProblem& point) const;
  /// Returns the coordinates in the basis of a vector in those of the points of a set.
  std::vector<Complex> lifted(int set, const std::vector<Complex>& q) const {
    return basis_.set(set).space.lifted(q);
  }
  /// Collective. Returns the projection of the terms that belong only to the point.
  linalg::DenseProblem projectOwn(const PointProblem& point) const;
  PetscInt basisSize() const { return basis().size(); }
  const Basis& basis() const { return basis_.basis(); }
  /// Returns the band of all sets; its top is 0 if nothing is corrected, and infinite if V is the
  /// whole space.
  const pencil::WatchedBand& band() const { return band_; }
  /// Collective. Adds corrections of the residuals of these pairs, of any points, all solved for
  /// together. The vectors may be of an earlier, smaller basis.
  Improvement improve(
      const std::vector<std::pair<PointProblem, std::vector<linalg::DensePair>>>& located);

 private:
  std::vector<PointState> statesOf(const std::vector<PointProblem>& batch);
  void correct(std::vector<PointState>& states);
  void solveDense(const std::vector<PointState*>& open);
  std::vector<PointState*> incompleteStates(std::vector<PointState>& states);
  std::vector<PointState*> recheck(std::vector<PointState>& states);
  bool addCorrections(const std::vector<PointState*>& open);
  void store(const std::vector<PointState>& states, const std::vector<PointState*>& open, int round,
             PetscInt largest);
  PointState associatedState(const PointProblem& point);
  void settleBand(std::vector<double> values, PointSet& set) const;
  pencil::ComplexModes result(const PointState& state) const;
  void keepShapes(std::vector<pencil::ComplexModes>& points, const std::vector<PointState>& states,
                  Mat trial) const;

  const Settings settings_;
  std::vector<double> frequencies_;  // of the free modes that start the basis, rad/s
  ProjectedBasis basis_;
  pencil::WatchedBand band_;
  ErrorEstimator estimator_;
  Corrector corrector_;
  PointNorms norms_;
  SolvedPairs solved_;
  Pod pod_;
  std::optional<subspace::ModeCount> count_;  // with boundary unknowns
  bool started_ = false;                      // static responses are in the basis
  std::function<void()> afterRound_;
  std::optional<PendingBatch> pending_;  // between two rounds, or resumed from a checkpoint
};

}  // namespace squeal::reduction
