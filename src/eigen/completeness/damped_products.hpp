// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The products with the basis V that all points of a sweep with damping or rotation share.
#include <vector>

#include "algebra/linalg/block.hpp"
#include "eigen/completeness/damped.hpp"
#include "eigen/completeness/damped_bounds.hpp"
#include "eigen/subspace/substructure.hpp"

namespace squeal::completeness {

/// The matrices and products that all points have in common, with all vectors of the basis.
class CommonProducts {
 public:
  /// Collective. Adds the responses to the jumps to the basis.
  CommonProducts(reduction::ReducedProblem& reduced, const DampedSweep& sweep,
                 const std::vector<DampedList>& points, const KnownModes& known,
                 const pencil::Pencil& associated);
  /// Not collective. Returns the part that the points of a set use, without energy and mass.
  DampedSet of(const subspace::PointSpace& space) const;
  const std::vector<const pencil::Term*>& bodies() const { return bodies_; }
  /// Not collective. Returns Φ and B of a point for the rows of J that are not zero. Throws Error
  /// if B couples these rows with others: there J is zero, but D need not be.
  pencil::PointFactors restricted(const pencil::PointFactors& factors) const;

 private:
  void addJumps(reduction::ReducedProblem& reduced, const reduction::PointProblem& point,
                const linalg::Block& transposed);
  void addNormals(reduction::ReducedProblem& reduced, const pencil::JumpFactors& factors, Mat mass);
  void addBodies(const DampedSweep& sweep, const std::vector<DampedList>& points);
  void addProducts(reduction::ReducedProblem& reduced, const std::vector<double>& lambda, Mat mass);
  std::vector<const pencil::Term*> bodies_;  // of the first point
  std::vector<PetscInt> jumpRows_;
  DampedSet all_;
};

}  // namespace squeal::completeness
