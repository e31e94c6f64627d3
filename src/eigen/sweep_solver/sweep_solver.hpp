#pragma once
/// The algebraic part of the method leads from K0, M0 and the terms of the pencil to the
/// eigenvalues of a sweep. It is the same for a mesh and for matrices from files.
#include <optional>
#include <string>
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "base/checkpoint/checkpoint.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sensitivity/left.hpp"
#include "eigen/stability/followed.hpp"
#include "eigen/subspace/substructure.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep_solver/settings.hpp"

namespace squeal::sweep_solver {

/// The results at steady points in a row that share one active set, and the modes of that set.
struct ModalSegment {
  PetscInt openNodes = 0;  ///< contact nodes that are not active, over all ranks
  PetscInt unknowns = 0;   ///< n
  modes::Modes modes;      ///< empty with the direct method; those of the band where the basis is
                           ///< shared with other active sets
  /// The first modes, Request::reportedModes of them, in nodal displacements, N entries each, with
  /// a largest entry of magnitude 1.
  std::vector<OwnedVec> shapes;
  std::vector<pencil::ComplexModes> points;  ///< for each damping factor all steady points
  /// For each speed, pressure and damping whose first point is one of these, if eigenvalues are
  /// followed.
  std::vector<stability::Followed> followed;
  long solves = 0;  ///< right-hand sides solved for to correct the basis and to estimate errors
};

/// An active set, and the steady points in a row that have it.
struct PointRange {
  std::size_t first = 0, last = 0;  ///< steady points [first, last); none where the active set is
                                    ///< only passed through between points
  PetscInt openNodes = 0;           ///< contact nodes that are not active, over all ranks
  /// [boundary unknown of all ranks] 1 where it is an unknown of these points
  std::vector<unsigned char> has;
  std::vector<pencil::Term> terms;  ///< of these points, beside those of all points
};

/// A part of the way along the friction with one active set, while the other parameters are fixed.
struct PathPiece {
  std::size_t range = 0;    ///< of SegmentProblem::ranges()
  double from = 0, to = 0;  ///< friction
};

/// The problem of steady points in a row whose basis has one factorisation, of a mesh or of
/// matrices from files. Everything that it returns by reference or handle is borrowed.
class SegmentProblem {
 public:
  virtual ~SegmentProblem() = default;
  /// Returns K0 and M0 of the interior unknowns with the solver of K0.
  virtual const factor::AssociatedSystem& system() const = 0;
  /// Returns the boundary unknowns: the gaps, and tangential displacements, of the contact nodes
  /// that are active at some of the points alone.
  virtual const subspace::Substructure& substructure() const {
    static const subspace::Substructure none;
    return none;
  }
  /// Collective. Returns the points by their active sets; without boundary unknowns there is one.
  virtual std::vector<PointRange> ranges() const {
    std::vector<PointRange> all(1);
    all[0].last = steadyPoints().size();
    return all;
  }
  /// Returns the way along the friction of the points that differ from steadyPoints()[first] in
  /// nothing else, `count` of them.
  virtual std::vector<PathPiece> path(std::size_t first, std::size_t count) const {
    return {{0, steadyPoints()[first].friction, steadyPoints()[first + count - 1].friction}};
  }
  /// Returns the friction of the point before steadyPoints()[first] if the two differ in friction
  /// alone and that point is in another problem.
  virtual std::optional<double> frictionBefore(std::size_t /*first*/) const { return {}; }
  /// Returns the matrix from all unknowns to what is reported.
  virtual Mat trial() const = 0;
  /// Returns the points, with damping 1.
  virtual const std::vector<sweep::Parameters>& steadyPoints() const = 0;
  /// Collective. Returns the terms that hold at all points.
  virtual pencil::Pencil pencil() const = 0;
  /// Collective. Returns the terms that belong to steadyPoints()[i] alone.
  virtual std::vector<pencil::Term> termsOf(std::size_t /*i*/) const { return {}; }
  /// Collective. Returns the same for a point between those of the sweep, where termsOf() gives
  /// any; none if the point has another active set than steadyPoints()[like], or no steady state.
  virtual std::optional<std::vector<pencil::Term>> termsAt(const sweep::Parameters& /*at*/,
                                                           std::size_t /*like*/) {
    return std::vector<pencil::Term>();
  }
  /// Collective. Adds to `point`, which belongs to steadyPoints()[i], its friction work and
  /// sensitivities as far as they are wanted. The pencil is that of the point; left vectors are
  /// looked for from `start`.
  virtual void examine(std::size_t i, const pencil::Pencil& pencil,
                       const sensitivity::StartSpace& start, pencil::ComplexModes& point) = 0;
};

/// The results of a problem.
struct SolvedSegments {
  std::vector<ModalSegment> segments;  ///< [range of points that has any]
  /// False if the run has been asked to stop: points may be missing, and what is followed.
  bool complete = true;
  /// Why points, or what is followed, are missing: a line for each point or stage that failed.
  std::vector<std::string> failures = {};
};

/// The sweep that is asked for.
struct Request {
  Settings settings;
  std::vector<double> dampings;  ///< swept at all steady points
  int reportedModes = 0;         ///< number of free modes whose shapes are reported
};

/// Collective. Returns for each range of points their modes, flutter at all steady points with all
/// dampings, and the eigenvalues followed over the friction. What the logs of the checkpoint
/// whose names begin with `name` hold is taken from there, and they are continued. A point
/// that fails leaves the others as they are, and so does a stage behind points that have been
/// solved: the reasons are returned. Throws Error if no point is solved.
SolvedSegments solveSegments(SegmentProblem& problem, const Request& request,
                             checkpoint::Checkpoint& checkpoint, const std::string& name);

}  // namespace squeal::sweep_solver
