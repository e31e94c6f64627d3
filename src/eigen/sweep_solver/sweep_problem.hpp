// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The problem of a sweep: the terms of its points, and the order of their active sets.
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
  /// Collective. Returns the terms that only these points have; SweepProblem::pencil has those of
  /// all points. If the function is empty, there are none.
  std::function<std::vector<pencil::Term>()> terms = {};
  /// Of a set between points: the rows of SweepProblem::releasedFriction() whose nodes slide,
  /// ascending, the same on all ranks. `terms` contains the products of these rows.
  std::vector<PetscInt> slidingRows = {};

  bool isPassed() const { return first == last; }  ///< it occurs only between points
};

/// An interval of friction with one active set; the other parameters are fixed.
struct PathPiece {
  std::optional<std::size_t> range;  ///< index in SweepProblem::ranges; none: unknown
  double from = 0, to = 0;           ///< friction
};

/// The data of a point between two points of the sweep.
struct PointBetween {
  std::vector<pencil::Term> terms;  ///< that belong only to this point
  /// Collective. Returns the forms yᴴ (∂P/∂θ) x of all parameters θ. Borrows the pencil, which
  /// contains the terms of the point, during the lifetime of the forms. If the function is empty,
  /// there are no derivatives.
  std::function<sensitivity::Forms(const pencil::Pencil&)> forms;
};

/// The factors of the friction terms of all ranges.
struct RangeFactors {
  pencil::FrictionFactors factors;
  /// [range] rows of the factors whose nodes slide, ascending; the same on all ranks
  std::vector<std::vector<PetscInt>> rowsOf;
};

/// The problem of consecutive steady points that share a basis and a factorisation, from a mesh or
/// from matrix files. Handles are borrowed.
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
  std::optional<pencil::Pencil> pencil;  ///< the terms of all points; always has a value
  /// [steady point] the path to it from the preceding point, if the two differ only in friction.
  /// The last piece has the active set of the point. It may be empty if all points have the same
  /// active set.
  std::vector<std::vector<PathPiece>> steps;
  /// The friction of the last point of the preceding problem, if that point and the first one here
  /// differ only in friction and this problem does not continue it.
  std::optional<double> frictionBefore;
  std::string whyNoBasis;  ///< why this problem does not continue that one
  /// [steady point] if a line begins there: why eigenvalues cannot be followed to it from friction
  /// 0, empty if they can. It may have no entries.
  std::vector<std::string> whyNotFromZero;
  /// True if steadyPoints[0] is the last point of the preceding problem and differs from the next
  /// point only in friction. It is solved again, in this basis, so that its eigenvalues can be
  /// continued, and has no results here.
  bool continues = false;
  bool isContinued = false;  ///< the next problem continues this one
  int rangesBefore = 0;      ///< number of ranges with results in all preceding problems

  /// Returns the path through `count` consecutive points, from steadyPoints[first] on. The points
  /// must differ only in friction, and all ranges must be known.
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
