// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tracking of the eigenvalues of a whole sweep over friction, with the critical frictions and a
/// statement on whether any eigenvalue is missing.
#include <optional>
#include <string>
#include <utility>
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
  std::size_t range = 0;          ///< index of the active set in the problem of the sweep
};

/// The points of one speed, pressure and damping.
struct Line {
  sweep::Parameters at;           ///< the parameters; `friction` has no meaning
  std::vector<double> swept;      ///< frictions of the sweep, ascending
  std::vector<LinePiece> pieces;  ///< ascending
  /// Friction of the preceding point, or 0, if the active set changes between it and the first
  /// point, or has no steady state there, and the line does not contain this step; none if the line
  /// continues another.
  std::optional<double> before;
  std::string whyNotFollowed;  ///< the reason for that; empty without `before`
  bool continues = false;      ///< begins with the last point of a line in the preceding basis
  bool isContinued = false;    ///< a line in the next basis begins with the last point
  const modes::Modes* modes = nullptr;  ///< free modes of the first piece, borrowed
};

/// The result for all frictions of one speed, pressure and damping: of one basis or, after append()
/// (continuation.hpp), of several.
struct TrackedLine {
  sweep::Parameters line;      ///< the parameters; `friction` has no meaning
  std::vector<int> activeSet;  ///< [piece of the path] its number in the results
  double from = 0;             ///< friction below which another active set applies; 0: none
  double begin = 0;            ///< first friction of the sweep on the line
  bool continues = false;      ///< `begin` is the last friction of a line in the preceding basis
  bool isContinued = false;    ///< a line in the next basis is to continue this one
  Branches branches;           ///< numbered from 1 by renumber()
  std::vector<Critical> criticals;  ///< critical frictions of the branches, ascending
  std::vector<pencil::CriticalMode> criticalModes;  ///< [critical]
  bool countExact = false;  ///< a Sturm count confirms the number at friction 0, the start
  bool wholeSpace = false;  ///< the basis spans the whole space of the full problem
  bool isDamped = false;    ///< the problem has a damping matrix
  /// Steps between whose ends the active set changes at frictions that are not known.
  std::vector<std::pair<double, double>> unlocated;

  /// Returns true if no eigenvalue of the band is missing at any friction.
  bool complete() const;
  /// Returns a statement on the number of eigenvalues: what is proven, and under which assumptions.
  std::string statement() const;
};

/// Returns true if a line is worth tracking: if it has several frictions or a preceding point with
/// friction, or if it is continued or, if tracking is `requested`, has a friction other than 0.
bool worthTracking(const Line& line, bool requested);
/// Returns the reason why no line can be tracked; empty if lines can be tracked. In a basis of only
/// the free modes, tracking is impossible.
std::string whyNotTracked(const reduction::ReducedProblem& reduced, const std::vector<Line>& lines);

/// Collective. Tracks the eigenvalues of the lines from friction 0 on, in the current basis. If the
/// settings request critical frictions, solves for them; this may extend the basis. Eigenvalues
/// jump at a change of the active set and are joined across it. If the first friction of a line is
/// not 0, tracking still starts at friction 0, with the first active set of the line, unless the
/// line continues another. Changes of stability below the first friction are dropped if
/// Line::before has a value.
std::vector<TrackedLine> trackLines(reduction::ReducedProblem& reduced,
                                    const std::vector<Line>& lines, const Settings& settings,
                                    MPI_Comm comm,
                                    const std::function<void(const std::string&)>& progress);

}  // namespace squeal::stability
