// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A sweep over friction in the reduced basis, as a Family.
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/tracking/family.hpp"

namespace squeal::tracking {

/// The terms common to all points of a line, and those of single points.
struct ProblemSource {
  std::function<pencil::Pencil()> shared;  ///< collective; returns the common terms
  /// Returns the problem of a point; none if there is no steady state with this active set.
  /// Collective.
  std::function<std::optional<reduction::PointProblem>(const sweep::Parameters&)> at;
  bool local = false;  ///< no point has terms of its own
  int set = 0;         ///< index of the points' set of boundary unknowns
};

/// The problems at all frictions of one speed, pressure and damping. If points have terms of their
/// own, at() computes a steady state and the projections of these terms on all ranks for each new
/// friction, and near() interpolates the projections.
class ReducedFamily : public Family {
 public:
  using Progress = std::function<void(const std::string&)>;
  /// Borrows all arguments except `line`, which is copied.
  ReducedFamily(reduction::ReducedProblem& reduced, MPI_Comm comm, const sweep::Parameters& line,
                const ProblemSource& source, const Progress& progress)
      : reduced_(reduced), comm_(comm), line_(line), source_(source), progress_(progress) {}
  MPI_Comm comm() const override { return comm_; }
  bool isAffine() const override { return source_.local; }
  std::optional<linalg::DenseProblem> at(double friction) override;
  std::optional<std::vector<linalg::DensePair>> watchedPairs(double friction) override {
    return reduced_.watchedPairs(point(friction), source_.set);
  }
  std::optional<linalg::DenseProblem> near(double friction) override;
  linalg::Spectrum shared(double friction, const std::vector<linalg::DensePair>& pairs) override;
  void addFrictions(const std::vector<double>& frictions) override;
  void progress(const std::string& text) override { progress_(text); }
  reduction::Improvement improve(const std::vector<PairsAtFriction>& located) override;
  reduction::Improvement errorsOf(const std::vector<PairsAtFriction>& located) override;

 private:
  /// The terms of the point at one friction, projected on the basis at the time of the projection.
  struct Node {
    double friction;
    PetscInt basisSize;
    linalg::DenseProblem own;
  };
  sweep::Parameters point(double friction) const;
  bool known(double friction) const;
  linalg::DenseProblem ofAll(double friction) const;
  void storeNode(Node node);
  std::vector<const Node*> nodesFor(double friction) const;
  double closest() const;
  /// The problems of located pairs that exist, and their places in the list.
  struct LocatedProblems {
    reduction::ReducedProblem::LocatedPairs list;
    std::vector<std::size_t> places;
  };
  LocatedProblems problemsOf(const std::vector<PairsAtFriction>& located) const;

  reduction::ReducedProblem& reduced_;
  MPI_Comm comm_;
  sweep::Parameters line_;
  const ProblemSource& source_;
  const Progress& progress_;
  std::vector<Node> nodes_;
};

}  // namespace squeal::tracking
