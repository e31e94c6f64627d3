#pragma once
/// The frictions at which stability changes, solved for rather than read off a grid.
#include <vector>

#include "tracking/track.hpp"

namespace squeal::tracking {

struct Critical {
  Event::Kind kind = Event::Kind::crossing;
  int branch = 0, partner = -1;
  double friction = 0;
  double angularFrequency = 0;  ///< rad/s
  /// crossing: d Re s/df, 1/s; coalescence: d (Re s)²/df, 1/s²; divergence: d Re s²/df, 1/s², or of
  /// a real s ds/df, 1/s
  double slope = 0;
  bool loss = true;          ///< of stability with rising friction; false: it is regained
  double errorEstimate = 0;  ///< of the friction: its change with the last improvement of the
                             ///< basis, and the tolerance of the root
  double backwardError = 0;  ///< of the large problem at this friction; 0: there is none
  bool converged = true;
};

/// Collective. Each event as the zero of a function that is analytic in f, inside its bracket:
/// - crossing: Re s(f) of one eigenvalue (Hopf);
/// - coalescence: −((s1 − s2)/2)² of the two-dimensional invariant subspace, which is simple where
/// s1 and s2 are square roots;
/// - divergence: Re s², or s where it is real at both ends.
/// After each root the family improves its basis for the pairs concerned, until the friction moves
/// by less than `tolerance` of itself.
std::vector<Critical> criticalFrictions(Family& family, const Branches& branches, double tolerance);

}  // namespace squeal::tracking
