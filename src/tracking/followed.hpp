#pragma once
/// A whole sweep over friction: its eigenvalues followed from point to point, their critical
/// frictions, and a statement on the completeness of their number.
#include <string>
#include <vector>

#include "modes/modes.hpp"
#include "pencil/complex_modes.hpp"
#include "reduction/reduced.hpp"
#include "sweep/parameters.hpp"
#include "tracking/critical.hpp"
#include "tracking/reducedfamily.hpp"

namespace squeal::tracking {

/// The result for all frictions of one speed, pressure and damping with one active set.
struct Followed {
  sweep::Parameters line;           ///< the other parameters; its friction has no meaning
  Branches branches;                ///< numbered from 1: renumber()
  std::vector<Critical> criticals;  ///< critical frictions of these branches, ascending
  bool countExact = false;  ///< the number at the first friction, 0, is that of the Sturm count
  bool wholeSpace = false;  ///< the reduced problem is the full one: the basis spans all of it

  /// Returns true if every eigenvalue of the band is accounted for at every friction.
  bool complete() const;
  /// Returns a sentence that says what is shown of the number of eigenvalues, and what is assumed.
  std::string statement() const;
};

/// Returns the option `-flutter_track`.
bool trackWanted();
/// Returns true if `-flutter_track` is given, or `-flutter_critical` is given and on. The user is
/// then told if there is nothing to follow.
bool trackAsked();
/// Returns the reason why there is nothing to follow; empty if there is something. Nothing is
/// followed in the basis of the free modes alone, nor for single frictions unless trackAsked().
std::string nothingToFollow(const reduction::ReducedProblem& reduced,
                            const std::vector<pencil::ComplexModes>& points);

/// Collective. Follows the eigenvalues of `points`, from friction 0 on, in the present basis, and
/// solves for the critical frictions (`-flutter_critical`), for which the basis may grow. Returns a
/// result for each speed, pressure and damping. Single frictions are left out unless trackAsked().
std::vector<Followed> followSweep(reduction::ReducedProblem& reduced,
                                  const std::vector<pencil::ComplexModes>& points,
                                  const modes::Modes& modes, MPI_Comm comm,
                                  const ProblemSource& source,
                                  const std::function<void(const std::string&)>& progress);

}  // namespace squeal::tracking
