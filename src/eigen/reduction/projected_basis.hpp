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
#include "eigen/reduction/point_state.hpp"
#include "eigen/reduction/projected.hpp"
#include "eigen/subspace/basis.hpp"

namespace squeal::reduction {

using subspace::Substructure;

/// A ProjectedBasis owns the basis, the terms that all points share, and those of the sets of
/// points with the same boundary unknowns.
class ProjectedBasis {
 public:
  /// Collective. Borrows the system during the life of the object and shares the terms of `pencil`,
  /// which hold at all points.
  ProjectedBasis(const pencil::Pencil& pencil, const factor::AssociatedSystem& system,
                 const modes::Modes& modes, Substructure substructure);
  Basis& basis() { return basis_; }
  const Basis& basis() const { return basis_; }
  /// Returns true if the basis spans the whole space.
  bool isComplete() const { return basis_.size() == unknowns_; }
  /// Returns the number of unknowns of the full problem.
  PetscInt unknowns() const { return unknowns_; }

  /// Collective. Adds the set of points with the boundary unknowns has[boundary unknown of all
  /// ranks], whose terms are those of `pencil` that follow the terms of all points and hold for all
  /// parameters. Returns its number. Throws Error if their stiffness is not positive definite.
  int addSet(const pencil::Pencil& pencil, const std::vector<unsigned char>& has);
  PointSet& set(int number) { return *sets_[number]; }
  const PointSet& set(int number) const { return *sets_[number]; }

  /// Collective. Returns a point with the projections of its own terms, not solved yet; the point
  /// is borrowed.
  PointState state(const PointProblem& point, const Norms& norms) const;
  /// Collective. Extends the projections of all terms to the vectors that the basis has gained.
  void extend(const std::vector<PointState*>& states);
  /// Not collective. Returns the projected problem of a point.
  linalg::DenseProblem project(const PointState& state) const;
  /// Not collective. Returns the same with all boundary unknowns, in coordinates that all points
  /// share.
  linalg::DenseProblem projectOnAll(const PointState& state) const;
  /// Not collective. Returns the projection of the terms that belong to the point only.
  linalg::DenseProblem projectOwn(const PointState& state) const;

  /// Not collective. Returns sketches of the residuals of one side, 2 Sketch::size × columns.
  linalg::DenseMatrix residualSketch(const PointState& state, const PointPairs& pairs,
                                     pencil::Side side) const;
  /// Collective. Returns the real and imaginary parts of P(s) x, or of P(s)ᴴ y, from the matrices
  /// themselves, by this rank's rows; only the real part for a pair of one column.
  linalg::Block residualColumns(const PointState& state, const linalg::DensePair& pair,
                                const linalg::ComplexVector& vector, pencil::Side side) const;
  /// Collective. Returns combinations of the residuals of pairs of several points, by this rank's
  /// rows. `combinations` has a row for each column of all pairs in turn.
  struct PairsOfPoint {
    const PointState* state;
    const PointPairs* pairs;
  };
  linalg::Block residuals(const std::vector<PairsOfPoint>& points,
                          const linalg::DenseMatrix& combinations) const;

  /// Collective. Replaces the basis, except its constraint modes, by the combinations of its
  /// vectors that are the columns of `directions`.
  void combine(const linalg::DenseMatrix& directions);
  /// Collective. Writes the vectors that the basis has gained since the last call, or adds them.
  /// All sets must be known. While it is written from, the archive borrows the basis.
  void exchange(checkpoint::Archive& archive);

 private:
  Basis basis_;
  ProjectedTerms terms_;
  PetscInt unknowns_ = 0;
  std::vector<std::unique_ptr<PointSet>> sets_;
  PetscInt exchanged_ = 0;  // vectors that a checkpoint has, or starts with
};

}  // namespace squeal::reduction
