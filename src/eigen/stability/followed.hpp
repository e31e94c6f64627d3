// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A whole sweep over friction: its eigenvalues followed from point to point, their critical
/// frictions, and a statement on the completeness of their number.
#include <optional>
#include <string>
#include <vector>

#include "eigen/modes/modes.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/stability/critical.hpp"
#include "eigen/stability/settings.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/tracking/reducedfamily.hpp"

namespace squeal::stability {

using tracking::Gap;
using tracking::Station;

/// A part of a line on which the active set does not change.
struct LinePiece {
  tracking::ProblemSource source;
  std::vector<double> frictions;  ///< ascending, with the ends of the piece
  int activeSet = 1;              ///< its number in the results
};

/// The points of one speed, pressure and damping.
struct Line {
  sweep::Parameters at;           ///< the other parameters; its friction has no meaning
  std::vector<double> swept;      ///< frictions of the sweep, ascending
  std::vector<LinePiece> pieces;  ///< ascending
  /// The friction of the point before the first one, of another basis: between the two, another
  /// active set takes over.
  std::optional<double> before;
  const modes::Modes* modes = nullptr;  ///< free modes of the first piece, borrowed
};

/// The result for all frictions of one speed, pressure and damping that share a basis.
struct Followed {
  sweep::Parameters line;      ///< the other parameters; its friction has no meaning
  std::vector<int> activeSet;  ///< [piece of the path] its number in the results
  double from = 0;    ///< friction below which another active set is in force; 0: there is none
  Branches branches;  ///< numbered from 1: renumber()
  std::vector<Critical> criticals;  ///< critical frictions of these branches, ascending
  bool countExact = false;  ///< the number at the first friction, 0, is that of the Sturm count
  bool wholeSpace = false;  ///< the reduced problem is the full one: the basis spans all of it

  /// Returns true if every eigenvalue of the band is accounted for at every friction.
  bool complete() const;
  /// Returns a sentence that says what is shown of the number of eigenvalues, and what is assumed.
  std::string statement() const;
};

/// Returns true if there is something to follow on a line: single frictions are omitted unless
/// tracking is `requested`.
bool worthFollowing(const Line& line, bool requested);
/// Returns the reason why there is nothing to follow on lines that are worth it; empty if there is
/// something. Nothing is followed in a basis of only the free modes.
std::string nothingToFollow(const reduction::ReducedProblem& reduced,
                            const std::vector<Line>& lines);

/// Collective. Follows the eigenvalues of the lines from friction 0 on, in the present basis, and
/// solves for the critical frictions if the settings ask for them; the basis may grow for these.
/// Where the active set changes, eigenvalues jump and are joined. A line whose first friction is
/// not 0 is followed from there with its first active set.
std::vector<Followed> followSweep(reduction::ReducedProblem& reduced,
                                  const std::vector<Line>& lines, const Settings& settings,
                                  MPI_Comm comm,
                                  const std::function<void(const std::string&)>& progress);

}  // namespace squeal::stability
