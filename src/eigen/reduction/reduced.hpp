// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The reduced problem [4.19], corrected until its eigenvalues agree with those of the full one.
/// Numbers in brackets refer to equations in docs/method.md, src/README.md explains the symbols,
/// and subspace::Substructure defines interior and boundary unknowns.
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

/// The result of ReducedProblem::improve(), and of tracking::Family::improve(): a family is a
/// problem with one active set, whose eigenvalues are tracked over friction. The lists have one
/// entry per point. They are empty if the family does not override Family::improve(): its dense
/// problem is then the full problem.
struct Improvement {
  /// True if the pairs must be computed again: the basis has grown or, in the result of
  /// tracking::Family::improve(), the interpolation of the terms between frictions was refined.
  bool changed = false;
  /// For each point, the largest backward error of its pairs in the full problem. NaN means that no
  /// steady state with the active set of the family exists at this friction; `roundOff` is then NaN
  /// as well. Only tracking::Family::improve() returns NaN.
  std::vector<double> backwardError;
  /// Upper bound of the round-off in yᴴP(s)x, for the pencil P(s) and unit vectors x and y of the
  /// reduced problem.
  std::vector<double> roundOff;
};

/// The Rayleigh–Ritz method in the space of the free modes and, unless `-flutter_basis modal` is
/// given, of static responses to the friction forces and to the residuals of Ritz pairs. With only
/// the modes, the method would miss unstable eigenvalues and report spurious ones. Each round adds
/// K0⁻¹ r for the residuals r of all inaccurate pairs. One block solve computes all these vectors,
/// with the real symmetric factorisation that was computed for the modes. A round reduces the
/// errors to about a tenth. A pair is certified if its full-order backward error is at most
/// `-flutter_accuracy` and the estimate of |δs|/|s| at most `-flutter_tolerance`. All points of the
/// object share one basis.
class ReducedProblem {
 public:
  /// Collective. Borrows the system of the interior unknowns during the lifetime of the object and
  /// shares the terms of `pencil`. These terms are valid at all points; their matrices have the
  /// rows of interior and boundary unknowns. `modes` are M0-orthonormal with ascending frequencies;
  /// they are copied.
  ReducedProblem(const pencil::Pencil& pencil, const factor::AssociatedSystem& system,
                 const modes::Modes& modes, const Settings& settings,
                 Substructure substructure = {});
  /// Collective. Adds a set of points that have the same boundary unknowns: has[i] is 1 if boundary
  /// unknown i, numbered over all ranks, is one of them. Returns the index of the set. `pencil`
  /// begins with the terms passed to the constructor. Its further terms apply to this set only, at
  /// all of its points; the object and `pencil` share their matrices. Throws Error if the stiffness
  /// is not positive definite.
  int addSet(const pencil::Pencil& pencil, const std::vector<unsigned char>& has);
  /// Collective. Sets the friction terms of the nodes that slide in some sets but not in all, as
  /// products of matrices.
  void setFactors(pencil::FrictionFactors factors) { basis_.setFactors(std::move(factors)); }
  /// Collective. Adds a set without points of the sweep, for an active set that occurs only between
  /// two points. Of the friction factors (setFactors()), it uses `slidingRows`, the rows of
  /// the nodes that slide. Only improve() calls `pencil`, on all ranks. See addSet() for the rest.
  int addPassedSet(std::function<pencil::Pencil()> pencil, const std::vector<unsigned char>& has,
                   std::vector<PetscInt> slidingRows) {
    return withBand(basis_.addPassedSet(std::move(pencil), has, std::move(slidingRows)));
  }
  /// Collective. Returns, for each of these sets, the free modes in the band. They are corrected
  /// together, in the same way as the complex modes. Their vectors have the entries of all
  /// unknowns. Their countConfirmed is true under two conditions. First, the number of interior
  /// modes is confirmed. Second, at some frequency above the band, the lower and the upper bound of
  /// subspace::ModeCount both equal the number of modes found below this frequency. After this
  /// call, whether or not the count is confirmed, these modes determine the top of the band at the
  /// points of the set. The eigenvalues that solve() lists at these points thus do not depend on
  /// the other sets of the basis. Of `pencil`, only the terms of K0 and M0 are used
  /// (Pencil::associated()).
  std::vector<modes::Modes> freeModes(const std::vector<int>& sets, const pencil::Pencil& pencil);
  /// Collective. Solves all points together and returns the complex modes of each. The dense
  /// problems are distributed over the ranks, and block solves give the corrections. The static
  /// responses are computed at the first point of the first batch. `trial` (T) maps vectors of the
  /// unknowns to nodal displacements.
  std::vector<pencil::ComplexModes> solve(const std::vector<PointProblem>& batch, Mat trial);
  /// Returns true if the basis only grows, that is, if it is never compressed; serialise() requires
  /// this.
  bool grows() const { return !settings_.compressed; }
  /// Makes solve() call `action`, which is collective, after each round of corrections.
  void afterEachRound(std::function<void()> action) { afterRound_ = std::move(action); }
  /// Collective. Writes or reads the results since the last call and the state of the current batch
  /// of solve(). After reading, the next solve() must have the same batch. All sets must have been
  /// added before the call. An archive that is being written borrows the basis.
  void serialise(checkpoint::Archive& archive);
  /// Collective. Returns the eigenpairs of the point with these parameters and this set: those in
  /// the band and in the guard zone around it (see pencil::WatchedBand), with right and left
  /// vectors. The coordinates are those of the basis at the time of the solve. Pairs in the band
  /// are those of solve(); pairs in the guard zone may be less accurate. Returns none if the pairs
  /// are not stored: the point has not been solved, the memory limit was reached, `-flutter_basis`
  /// is not `corrected`, or the free modes span the whole space.
  std::optional<std::vector<linalg::DensePair>> watchedPairs(const sweep::Parameters& at,
                                                             int set) const {
    return solved_.at(at, set);
  }
  /// Collective. Returns the projection of the problem at this point on the current basis.
  linalg::DenseProblem project(const PointProblem& point) const;
  /// Not collective. Returns the projection of the terms that all points of a set have.
  linalg::DenseProblem project(const sweep::Parameters& at, int set) const {
    return space(set).restricted(projectOnAll(at, set));
  }
  /// Not collective. Returns the same projection with all boundary unknowns.
  linalg::DenseProblem projectOnAll(const sweep::Parameters& at, int set) const {
    return basis_.projectOnAll(at, basis_.set(set));
  }
  /// Collective. Returns the projection with all boundary unknowns, even if the point has only some
  /// of them. Its coordinates are the same for all points.
  linalg::DenseProblem projectOnAll(const PointProblem& point) const {
    return basis_.projectOnAll(basis_.state(point, {}));
  }
  /// Converts a vector from the coordinates of the points of a set to those of the basis.
  std::vector<Complex> lifted(int set, const std::vector<Complex>& q) const {
    return basis_.set(set).space.lifted(q);
  }
  /// Collective. Returns the projection of the terms that belong only to the point.
  linalg::DenseProblem projectOwn(const PointProblem& point) const {
    return basis_.projectOwn(basis_.state(point, {}));
  }
  /// Not collective. Returns K0 and M0 projected on the vectors that the points of a set use; the
  /// damping matrix is empty.
  linalg::DenseProblem projectAssociated(int set) const {
    return space(set).restricted(projectAssociated());
  }
  /// Not collective. Returns K0 and M0 projected on the whole basis.
  linalg::DenseProblem projectAssociated() const { return basis_.projectAssociated(); }
  /// Returns the part of the basis that the points of a set use.
  const subspace::PointSpace& space(int set) const { return basis_.set(set).space; }
  /// Collective. Adds K0⁻¹ F to the basis for static forces F on the interior unknowns; `forces`
  /// has this rank's rows. Returns FᵀK0⁻¹F.
  linalg::DenseMatrix addResponses(linalg::Block forces);
  /// Collective. Returns K0⁻¹ F without changing the basis, with zeros at the boundary unknowns.
  linalg::Block responses(const linalg::Block& forces) { return basis_.basis().responses(forces); }
  /// Collective. Returns FᵀK0⁻¹F, from the interior rows of F, without changing the basis.
  linalg::DenseMatrix flexibility(const linalg::Block& forces) {
    return basis_.basis().flexibility(forces);
  }
  PetscInt basisSize() const { return basis().size(); }
  const Basis& basis() const { return basis_.basis(); }
  /// Returns the band that contains the bands of all sets. Its upper limit has two special
  /// values. It is infinity if the free modes span the whole space. If they do not, it is 0 with
  /// `-flutter_basis modal`, which corrects no eigenvalue.
  const pencil::WatchedBand& band() const { return band_; }
  /// Eigenpairs of several points. Their vectors may belong to an earlier, smaller basis.
  using LocatedPairs = std::vector<std::pair<PointProblem, std::vector<linalg::DensePair>>>;
  /// Collective. Returns the errors of these pairs, and adds corrections from their residuals to
  /// the basis, by one block solve.
  Improvement improve(const LocatedPairs& located);
  /// Collective. Returns the errors of these pairs.
  Improvement errorsOf(const LocatedPairs& located);

 private:
  std::vector<double> frequenciesUpTo(double top) const;
  int withBand(int number);
  std::vector<PointState> statesOf(const std::vector<PointProblem>& batch);
  void correct(std::vector<PointState>& states);
  std::vector<PointState> measuredStates(const LocatedPairs& located, Improvement& result);
  void solveDense(const std::vector<PointState*>& open);
  std::vector<PointState*> incompleteStates(std::vector<PointState>& states);
  std::vector<PointState*> recheck(std::vector<PointState>& states);
  bool addCorrections(const std::vector<PointState*>& open);
  void store(const std::vector<PointState>& states, const std::vector<PointState*>& open, int round,
             PetscInt largest);
  std::vector<PointState> associatedStates(const std::vector<PointProblem>& points);
  std::vector<std::vector<double>> associatedEigenvalues(
      const std::vector<PointState>& states) const;
  void confirmCounts(const std::vector<PointState>& states,
                     const std::vector<std::vector<double>>& values,
                     const pencil::Pencil& associated, std::vector<modes::Modes>& modes);
  void setBand(std::vector<double> values, PointSet& set) const;
  pencil::ComplexModes result(const PointState& state) const;
  void storeShapes(std::vector<pencil::ComplexModes>& points, const std::vector<PointState>& states,
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
  std::optional<subspace::ModeCount> count_;  // none without boundary unknowns
  bool started_ = false;                      // solve() has been called
  std::function<void()> afterRound_;
  std::optional<PendingBatch> pending_;  // between two rounds, or resumed from a checkpoint
};

}  // namespace squeal::reduction
