// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The eigenvalue problem of one group of sweep points: the matrix terms at each point, and the
/// sequence of active sets.
#include <functional>
#include <optional>
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/friction_factors.hpp"
#include "eigen/pencil/participation.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sensitivity/derive.hpp"
#include "eigen/sensitivity/null_vectors.hpp"
#include "eigen/subspace/substructure.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::sweep_solver {

/// An active set, and the consecutive steady points that have it.
struct PointRange {
  std::size_t first = 0, last = 0;  ///< steady points [first, last); first == last if the active
                                    ///< set occurs only between points
  PetscInt openNodes = 0;           ///< contact nodes that are not active, over all ranks
  /// [boundary unknown, over all ranks] 1 if it is an unknown of these points
  std::vector<unsigned char> has = {};
  /// Collective. Returns the terms that belong only to these points; SweepProblem::pencil has the
  /// terms that all points share. An empty function means that no such terms exist.
  std::function<std::vector<pencil::Term>()> terms = {};
  /// If the active set occurs only between points: the rows of SweepProblem::releasedFriction()
  /// that belong to sliding nodes, ascending; the same on all ranks. `terms` contains the products
  /// of these rows.
  std::vector<PetscInt> slidingRows = {};

  bool isPassed() const { return first == last; }  ///< it occurs only between points
};

/// An interval of friction with one active set; the other parameters are fixed.
struct PathPiece {
  std::optional<std::size_t> range;  ///< index in SweepProblem::ranges; empty: unknown set
  double from = 0, to = 0;           ///< friction
};

/// The data of a point between two points of the sweep.
struct PointBetween {
  std::vector<pencil::Term> terms;  ///< that belong only to this point
  /// Collective. Returns the forms yᴴ (∂P/∂θ) x for all parameters θ. Borrows the pencil, which
  /// contains the terms of the point, for the lifetime of the forms. An empty function means that
  /// no derivatives are known.
  std::function<sensitivity::Forms(const pencil::Pencil&)> forms;
};

/// The factors of the friction terms of all ranges.
struct RangeFactors {
  pencil::FrictionFactors factors;
  /// [range] rows of the factors that belong to sliding nodes, ascending; the same on all ranks
  std::vector<std::vector<PetscInt>> rowsOf;
};

/// The eigenvalue problem of a group: consecutive steady points that share one basis and one
/// factorisation. The matrices come from a mesh or from files. Handles are borrowed.
class SweepProblem {
 public:
  virtual ~SweepProblem() = default;

  const factor::AssociatedSystem* system = nullptr;  ///< K0 and M0 of the interior unknowns
  /// The boundary unknowns: those gaps and tangential displacements of contact nodes that are
  /// unknowns at only some of the points.
  subspace::Substructure substructure;
  Mat trial = nullptr;  ///< T: maps all unknowns to the reported vectors
  std::vector<sweep::Parameters>
      steadyPoints;                      ///< points with a steady state and a damping factor of 1
  std::vector<PointRange> ranges;        ///< one for each active set
  std::optional<pencil::Pencil> pencil;  ///< the terms that all points share; has a value
  /// [steady point] the path to it from the preceding point, if the two differ only in friction.
  /// The last piece has the active set of the point. The list `steps` may be empty if all points
  /// have the same active set.
  std::vector<std::vector<PathPiece>> steps;
  /// The friction at the last point of the preceding problem. It is set only if that point and
  /// steadyPoints[0] differ only in friction and `continues` is false.
  std::optional<double> frictionBefore;
  std::string whyNoBasis;  ///< with frictionBefore: why this problem does not continue that one
  /// [steady point] for the first point of a line (of consecutive points that differ only in
  /// friction): the reason why eigenvalues cannot be tracked to it from friction 0; an empty text
  /// if they can. The list may be empty.
  std::vector<std::string> whyNotFromZero;
  /// True if steadyPoints[0] is the last point of the preceding problem and differs from the next
  /// point only in friction. It is solved again in this basis so that its eigenvalues can be
  /// continued; its results are those of the preceding problem.
  bool continues = false;
  bool isContinued = false;  ///< the next problem continues this one
  int rangesBefore = 0;      ///< total number of ranges with results of the preceding problems

  /// Returns the path through `count` consecutive points, starting at steadyPoints[first]. The
  /// points must differ only in friction, and all ranges must be known.
  std::vector<PathPiece> path(std::size_t first, std::size_t count) const;

  /// Collective. Returns the terms that belong only to steadyPoints[i].
  virtual std::vector<pencil::Term> termsOf(std::size_t /*i*/) const { return {}; }
  /// Collective. Returns the factors of the friction terms of all ranges.
  virtual RangeFactors frictionFactors() const {
    return {{{}, {}, "the factors of the friction terms are not known"}, {}};
  }
  /// Collective. Returns the factors of the friction terms that all points share.
  virtual pencil::JumpFactors jumpFactors() const {
    return {{}, {}, {}, "the factors of the friction terms are not known"};
  }
  /// Collective. Returns the factors that belong only to steadyPoints[i].
  virtual pencil::PointFactors factorsAt(std::size_t /*i*/) const { return {}; }
  /// Collective. Returns the factors of the friction terms that only some of the ranges have.
  virtual pencil::FrictionFactors releasedFriction() const { return {}; }
  /// Collective. Returns the data of a point between two points of the sweep; none if no steady
  /// state with the active set of this range is found there. The forms borrow this problem.
  virtual std::optional<PointBetween> between(const sweep::Parameters& /*at*/,
                                              std::size_t /*range*/) {
    return PointBetween();
  }
  /// Collective. Adds to `point`, which belongs to steadyPoints[i], its friction work and the
  /// requested sensitivities. `pencil` belongs to the point; the search for left vectors starts
  /// from `start`.
  virtual void examine(std::size_t i, const pencil::Pencil& pencil,
                       const sensitivity::StartSpace& start, pencil::ComplexModes& point) = 0;
  /// Collective. Returns, for each of these complex modes, its name and the shares of the free
  /// modes in it. The vectors of `motions` have one entry per unknown.
  virtual std::vector<pencil::CriticalMode> describe(
      const std::vector<pencil::ComplexMotion>& motions, const modes::Modes& /*modes*/) const {
    return std::vector<pencil::CriticalMode>(motions.size());
  }
};

}  // namespace squeal::sweep_solver
