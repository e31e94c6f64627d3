// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Eigenvalues tracked as the friction changes, through crossings and mergers, by their left and
/// right vectors.
#include <string>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/rayleigh_ritz.hpp"
#include "eigen/pencil/band.hpp"
#include "eigen/tracking/family.hpp"

namespace squeal::tracking {

/// One friction of a tracked sweep.
struct Station {
  double friction = 0;
  bool swept = true;  ///< false: inserted to make a continuation certain
  /// Eigenpairs in the band or in the guard zone around it (band.hpp); without vectors in the
  /// result of track().
  std::vector<linalg::DensePair> pairs;
  std::vector<int> branch = {};  ///< [pair] number of its branch
  /// [pair] |tr(Π Π')| with the preceding station (track()); 1 if a group was joined as a whole; 0
  /// at the start of the branch
  std::vector<double> overlap = {};
  std::vector<unsigned char> inBand = {};  ///< [pair] 1 if it is in the band
  std::size_t piece = 0;                   ///< index of the Piece in the path
};

/// A change of stability between two frictions.
struct Event {
  /// `contact`: the eigenvalue jumps where the active set changes.
  enum class Kind { coalescence, crossing, divergence, contact } kind = Kind::crossing;
  int branch = 0, partner = -1;
  bool loss = true;  ///< stability is lost with rising friction; false: it is regained
  /// Bracket of the friction; equal if it is exact, for example where a double eigenvalue splits.
  double low = 0, high = 0;
  /// The pairs involved, at or below `low` and at or above `high`. If two equal eigenvalues cross
  /// the axis or diverge together, there are two events, one for each branch. Each has both pairs
  /// and describes their mean.
  std::vector<linalg::DensePair> below = {}, above = {};
  double isolation = 0;   ///< distance from other eigenvalues and from 0, rad/s; 0: not computed
  std::size_t piece = 0;  ///< index of the Piece in the path; at a jump, of the later one
};

/// A range of frictions with an uncertain continuation.
struct Gap {
  double from = 0, to = 0;
  std::string reason;
  bool identityOnly = false;  ///< no eigenvalue is missing, but some cannot be distinguished
};

/// The result of tracking.
struct Branches {
  pencil::WatchedBand band;
  std::vector<Station> stations;  ///< ascending friction
  std::vector<Event> events;
  std::vector<Gap> gaps;
  int count = 0;              ///< number of branches
  int entered = 0, left = 0;  ///< numbers of eigenvalues that have entered and left the band
  int omitted = 0;            ///< number of pieces of the path that were not examined
  int inBandAt(const Station& station) const;
};

struct TrackLimits {
  /// Smallest step with a full solve, as a fraction of a step of the sweep.
  double smallest = 1. / 1024;
  /// Frictions of a piece that are not needed (Piece::needed) may be omitted. Between two needed
  /// ones, all are examined if the families are affine or if at most `examined` may be omitted.
  /// Otherwise the interval is bisected. Bisection ends where the continuation is certain and no
  /// eigenvalue changes its stability, or where no friction is left in between.
  std::size_t examined = 32;
};

/// A part of a path on which the problem is a smooth function of the friction.
struct Piece {
  Family* family = nullptr;       ///< borrowed
  std::vector<double> frictions;  ///< ascending; the next piece begins where this one ends
  /// [friction] 0 if it may be omitted (TrackLimits::examined); empty: all are needed
  std::vector<unsigned char> needed = {};
};

/// Collective. Tracks all eigenvalues of the band and its guard zone through ascending frictions. A
/// continuation is certain if the trace of the product of the spectral projectors at both ends,
/// tr(Π Π') [M.41], is close to the number of eigenvalues joined. Otherwise the step is halved. If
/// two eigenvalues mix, only their common subspace is followed on the smaller steps; in other cases
/// all eigenvalues are computed there.
///
/// By convention, where two neutral branches merge, the one of lower frequency becomes the growing
/// one; where a growing and a decaying branch become neutral, the growing one gets the lower
/// frequency. Branches that leave a multiple eigenvalue are numbered by ascending frequency, then
/// by descending growth rate.
Branches track(Family& family, const std::vector<double>& frictions,
               const pencil::WatchedBand& band, const TrackLimits& limits = {});
/// Collective. Does the same along a path. Eigenvalues jump from one piece to the next. Those on
/// both sides of a jump are joined by the same traces, in common coordinates of the families; no
/// frictions are inserted. A jump across the imaginary axis is an event, and an uncertain jump is a
/// gap.
Branches track(const std::vector<Piece>& path, const pencil::WatchedBand& band,
               const TrackLimits& limits = {});

}  // namespace squeal::tracking
