// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Eigenvalues tracked over the friction, through crossings and mergers, by their left and right
/// vectors.
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
  bool swept = true;                     ///< false: inserted to make a continuation certain
  std::vector<linalg::DensePair> pairs;  ///< in the band or in its guard zone, with left vectors
  std::vector<int> branch = {};          ///< [pair] number of its branch
  std::vector<double> overlap = {};  ///< [pair] |tr(Π Π')| with the preceding station; 1 if a group
                                     ///< was joined as a whole; 0 at the start of the branch
  std::vector<unsigned char> inBand = {};  ///< [pair] 1 if it is in the band
  std::size_t piece = 0;                   ///< of the path
};

/// A change of stability between two frictions.
struct Event {
  /// `contact`: the eigenvalue jumps where the active set changes.
  enum class Kind { coalescence, crossing, divergence, contact } kind = Kind::crossing;
  int branch = 0, partner = -1;
  bool loss = true;          ///< stability is lost with rising friction; false: it is regained
  double low = 0, high = 0;  ///< bracket of the friction; if equal, the event is at this friction,
                             ///< as where a double eigenvalue splits at once
  /// The pairs concerned at `low` and at `high`. A crossing or divergence has two pairs if equal
  /// eigenvalues change their stability together; each then has an event with the mean of both.
  std::vector<linalg::DensePair> below = {}, above = {};
  double isolation = 0;   ///< distance from other eigenvalues, rad/s
  std::size_t piece = 0;  ///< of the path; at a jump the one that begins at the jump
};

/// A range of frictions with an uncertain continuation.
struct Gap {
  double from = 0, to = 0;
  std::string reason;
  bool identityOnly = false;  ///< no eigenvalue is missing, but they cannot be distinguished
};

/// The result of tracking.
struct Branches {
  pencil::WatchedBand band;
  std::vector<Station> stations;  ///< ascending friction
  std::vector<Event> events;
  std::vector<Gap> gaps;
  int count = 0;              ///< number of branches
  int entered = 0, left = 0;  ///< numbers of eigenvalues that have crossed the edge of the band
  int omitted = 0;            ///< pieces of the path that were not examined
  int inBandAt(const Station& station) const;
};

struct TrackLimits {
  /// Smallest step with a full solve, as a fraction of a step of the sweep.
  double smallest = 1. / 1024;
  /// The largest number of frictions that may be omitted between two needed ones and yet are all
  /// examined. Of more, only those are examined that a bisection of the path needs until each
  /// continuation is certain and without a change of stability.
  std::size_t examined = 32;
};

/// A part of a path on which the problem is a smooth function of the friction.
struct Piece {
  Family* family = nullptr;       ///< borrowed
  std::vector<double> frictions;  ///< ascending; the next piece begins where this one ends
  /// [friction] 0 if it may be omitted (TrackLimits::examined); empty: none may
  std::vector<unsigned char> needed = {};
};

/// Collective. Tracks all eigenvalues of the band over ascending frictions. A continuation is
/// certain if the trace of the product of the spectral projectors at both ends, tr(Π Π') [M.41], is
/// close to the number of eigenvalues joined. Other steps are halved. For two eigenvalues that mix,
/// this is done only in their common subspace, otherwise with all eigenvalues.
///
/// By convention, where two neutral branches merge, the one of lower frequency becomes the growing
/// one; where a growing and a decaying branch become neutral, the growing one gets the lower
/// frequency. Equal eigenvalues are ordered by frequency, then by growth rate.
Branches track(Family& family, const std::vector<double>& frictions,
               const pencil::WatchedBand& band, const TrackLimits& limits = {});
/// Collective. Does the same along a path. Eigenvalues jump from one piece to the next. The same
/// projectors join them, in common coordinates of the families, without frictions in between. A
/// jump across the imaginary axis is an event, and an uncertain jump is a gap.
Branches track(const std::vector<Piece>& path, const pencil::WatchedBand& band,
               const TrackLimits& limits = {});

}  // namespace squeal::tracking
