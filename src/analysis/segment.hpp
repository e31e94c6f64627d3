#pragma once
/// The algebraic part of the method leads from K0, M0 and the terms of the pencil to the
/// eigenvalues of a sweep. It is the same for a mesh and for matrices from files.
#include <optional>
#include <vector>

#include "modes/associated.hpp"
#include "modes/modes.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "sensitivity/left.hpp"
#include "sweep/parameters.hpp"
#include "tracking/followed.hpp"

namespace squeal::analysis {

/// The results at steady points in a row that share one active set, and the modes of that set.
struct ModalSegment {
  PetscInt openNodes = 0;  ///< contact nodes that are not active, over all ranks
  PetscInt unknowns = 0;   ///< n
  modes::Modes modes;      ///< empty with the direct method
  /// The first `-report_modes` modes in nodal displacements, N entries each, the largest entry 1 in
  /// magnitude.
  std::vector<OwnedVec> shapes;
  std::vector<pencil::ComplexModes> points;  ///< for each damping factor all steady points
  std::vector<tracking::Followed> followed;  ///< for each speed, pressure and damping, if
                                             ///< eigenvalues are followed
  long solves = 0;  ///< right-hand sides solved for to correct the basis and to estimate errors
};

/// The problem of one segment: steady points with one active set, of a mesh or of matrices from
/// files. Everything that it returns by reference or handle is borrowed.
class SegmentProblem {
 public:
  virtual ~SegmentProblem() = default;
  /// Returns K0 and M0 with the solver of K0.
  virtual const modes::AssociatedSystem& system() const = 0;
  /// Returns the matrix from the unknowns, n, to what is reported, N×n.
  virtual Mat trial() const = 0;
  /// Returns the points, with damping 1.
  virtual const std::vector<sweep::Parameters>& steadyPoints() const = 0;
  /// Collective. Returns the terms that hold at all points.
  virtual pencil::Pencil pencil() const = 0;
  /// Collective. Returns the terms that belong to steadyPoints()[i] alone.
  virtual std::vector<pencil::Term> termsOf(std::size_t /*i*/) const { return {}; }
  /// Collective. Returns the same for a point between those of the sweep, where termsOf() gives
  /// any; none if the point has another active set, or no steady state.
  virtual std::optional<std::vector<pencil::Term>> termsAt(const sweep::Parameters& /*at*/) {
    return std::vector<pencil::Term>();
  }
  /// Collective. Adds to `point`, which belongs to steadyPoints()[i], its friction work and
  /// sensitivities as far as they are wanted. The pencil is that of the point; left vectors are
  /// looked for from `start`.
  virtual void examine(std::size_t i, const pencil::Pencil& pencil,
                       const sensitivity::StartSpace& start, pencil::ComplexModes& point) = 0;
};

/// Collective. Returns the modes, flutter at all steady points with all `dampings`, and the
/// eigenvalues followed over the friction. Throws Error as the stages modes, flutter and track do,
/// and if an eigenvalue is not a finite number.
ModalSegment solveSegment(SegmentProblem& problem, const std::vector<double>& dampings);

}  // namespace squeal::analysis
