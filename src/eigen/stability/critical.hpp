// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Critical frictions: the frictions at which stability changes, as roots of analytic functions.
#include <vector>

#include "eigen/tracking/track.hpp"

namespace squeal::stability {

using tracking::Branches;
using tracking::Event;
using tracking::Family;
using tracking::Piece;

/// One critical friction.
struct Critical {
  Event::Kind kind = Event::Kind::crossing;
  int branch = 0, partner = -1;
  double friction = 0;
  double angularFrequency = 0;  ///< rad/s
  /// Derivative with respect to the friction. Crossing: d Re s/df, 1/s. Coalescence: d (Re s)²/df,
  /// 1/s². Divergence: d Re s²/df, 1/s² (in a damped problem with real s on both sides: ds/df,
  /// 1/s).
  double slope = 0;
  bool loss = true;          ///< stability is lost with rising friction; false: it is regained
  double errorEstimate = 0;  ///< estimate of the error of `friction`: the sum of its change in the
                             ///< last improvement of the basis, the tolerance of the root, and the
                             ///< shift of the root by round-off
  double backwardError = 0;  ///< backward error in the full problem here; 0: not computed
  bool converged = true;     ///< the basis was improved until `friction` settled
  std::size_t piece = 0;     ///< index of the piece of the path
};

/// Collective. Returns a critical friction for each event of `branches`, in ascending order. It is
/// the root, inside the bracket of the event, of a function that is analytic in f [M.44]:
///   crossing (Hopf):   Re s of one eigenvalue
///   coalescence:       −((s1 − s2)/2)² of the two-dimensional invariant subspace
///   divergence:        Re s², or s in a damped problem where s is real at both ends
/// At a coalescence s1 and s2 themselves behave like square roots. After each search the family
/// improves its basis by the pairs at the roots, and the roots are located again. This ends when
/// the relative change of the friction is at most `tolerance`, or after ten rounds. Throws Error if
/// LAPACK fails. If an eigenvalue jumps at a change of the active set, its critical friction is
/// that of the change, and the eigenvalue after the jump is improved in the same way. Two
/// coalescences of the same eigenvalues that cancel within their errors are omitted: the
/// eigenvalues cross.
std::vector<Critical> criticalFrictions(Family& family, const Branches& branches, double tolerance);
/// Collective. Does the same for branches of a path.
std::vector<Critical> criticalFrictions(const std::vector<Piece>& path, const Branches& branches,
                                        double tolerance);

}  // namespace squeal::stability
