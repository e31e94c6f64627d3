// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The basis of the reduced problem with the terms of the pencil projected on it.
#include <memory>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/complexvector.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "base/checkpoint/archive.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/reduction/factored_friction.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/reduction/projected.hpp"
#include "eigen/subspace/basis.hpp"

namespace squeal::reduction {

using subspace::Substructure;

/// Owns the basis V and the projections on it: of the terms common to all points, and of the terms
/// of each set. The points of a set have the same boundary unknowns, those that only some points
/// have (substructure.hpp). K0 and M0 are stiffness and mass of the free modes.
class ProjectedBasis {
 public:
  /// Collective. Borrows the system during the lifetime of the object. `pencil` must have exactly
  /// the terms common to all points; their matrices are shared, not copied.
  ProjectedBasis(const pencil::Pencil& pencil, const factor::AssociatedSystem& system,
                 const modes::Modes& modes, Substructure substructure);
  Basis& basis() { return basis_; }
  const Basis& basis() const { return basis_; }
  /// Returns true if the basis spans the whole space.
  bool isComplete() const { return basis_.size() == unknowns_; }
  /// Returns the number of unknowns of the full problem.
  PetscInt unknowns() const { return unknowns_; }

  /// Collective. Adds a set of points with the same boundary unknowns and returns its index. has[i]
  /// is 1 if the points have boundary unknown i, numbered over all ranks. `pencil` begins with the
  /// terms common to all points. Its further terms become those of the set; terms of single points
  /// are ignored. Throws Error if the stiffness is not positive definite.
  int addSet(const pencil::Pencil& pencil, const std::vector<unsigned char>& has);
  /// Collective. Sets the friction terms of the nodes that slide in some sets but not in all, as
  /// products of matrices. Must be called before addPassedSet().
  void setFactors(pencil::FrictionFactors factors) {
    friction_.emplace(basis_, std::move(factors));
  }
  /// Collective. Adds a passed set, one that occurs only between two points of the sweep.
  /// `slidingRows` are the rows of the friction factors that belong to sliding nodes. `pencil`, a
  /// collective function, is called only by load().
  int addPassedSet(std::function<pencil::Pencil()> pencil, const std::vector<unsigned char>& has,
                   std::vector<PetscInt> slidingRows);
  /// Collective. Projects the terms of a passed set, unless they are loaded. Required for residuals
  /// and for extend() with states of the set. Between two points there may be hundreds of passed
  /// sets. Only `mostLoaded` of them keep their terms and projections, those used last.
  void load(int set);
  PointSet& set(int number) { return *sets_[number]; }
  const PointSet& set(int number) const { return *sets_[number]; }

  /// Collective. Returns the state of a point before it is solved, with the projections of its own
  /// terms. Borrows the point.
  PointState state(const PointProblem& point, const Norms& norms) const;
  /// Collective. Extends the projections of all terms to the new vectors of the basis.
  void extend(const std::vector<PointState*>& states);
  /// Not collective. Returns the projected problem of a point.
  linalg::DenseProblem project(const PointState& state) const;
  /// Not collective. Returns the terms common to all points of a set, projected on the whole basis,
  /// which also has the boundary unknowns that the set lacks.
  linalg::DenseProblem projectOnAll(const sweep::Parameters& at, const PointSet& set) const;
  /// Not collective. Returns the projected problem with all boundary unknowns, in coordinates
  /// common to all points.
  linalg::DenseProblem projectOnAll(const PointState& state) const;
  /// Not collective. Returns the projection of K0 and M0 with all boundary unknowns.
  linalg::DenseProblem projectAssociated() const;
  /// Not collective. Returns the projection of the terms that belong only to the point.
  linalg::DenseProblem projectOwn(const PointState& state) const;

  /// Not collective. Returns sketches of the right or left residuals of some pairs, with
  /// 2 Sketch::size rows, and with the columns of Coordinates.
  linalg::DenseMatrix residualSketch(const PointState& state, const PointPairs& pairs,
                                     pencil::Side side) const;
  /// Collective. Computes P(s) x, or P(s)ᴴ y, from the full matrices, with zeros in the rows of the
  /// boundary. Returns this rank's rows of the real and the imaginary part in two columns. A pair
  /// that takes one column in Coordinates has only the real part.
  linalg::Block residualColumns(const PointState& state, const linalg::DensePair& pair,
                                const linalg::ComplexVector& vector, pencil::Side side) const;
  /// Pairs of one point, both borrowed.
  struct PairsOfPoint {
    const PointState* state;
    const PointPairs* pairs;
  };
  /// `whole`: the residuals R of some pairs. `outside`: R − K0 V (VᵀK0V)⁻¹ VᵀR, or R if no term has
  /// the matrix K0. K0⁻¹ times the residuals `outside` is nearly orthogonal to V in energy, and
  /// adds the same space to V as K0⁻¹ R.
  enum class Residual { whole, outside };
  /// Collective. Returns this rank's rows of combinations of the residuals of several pairs, with
  /// zeros in the rows of the boundary. `combinations` has a row for each column of each pair, in
  /// the order of the points.
  linalg::Block residuals(const std::vector<PairsOfPoint>& points,
                          const linalg::DenseMatrix& combinations, Residual kind) const;

  /// Collective. Replaces the basis, except its constraint modes, by combinations of its vectors,
  /// whose coefficients are the columns of `directions`.
  void combine(const linalg::DenseMatrix& directions);
  /// Collective. Writes the vectors added since the last call or since construction, the tops of
  /// the bands and the counters, or reads them and appends the vectors. All sets must have been
  /// added before. An archive that is being written borrows the basis.
  void serialise(checkpoint::Archive& archive);

 private:
  static constexpr std::size_t mostLoaded = 2;
  void projectTerms(PointSet& set) const;
  int newSet(std::function<pencil::Pencil()> pencil, const std::vector<unsigned char>& has);
  linalg::DenseProblem projectOnAll(const Weights& weights, const PointSet& set) const;

  Basis basis_;
  ProjectedTerms terms_;
  std::optional<FactoredFriction> friction_;
  PetscInt unknowns_ = 0;
  std::vector<std::unique_ptr<PointSet>> sets_;
  std::vector<int> loaded_;  // passed sets, the most recently used one at the end
  PetscInt serialised_ = 0;  // number of vectors that the checkpoint contains
};

}  // namespace squeal::reduction
