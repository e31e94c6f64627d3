#pragma once
/// Eigenvalues followed over the friction by left and right vectors, through crossings and mergers,
/// rather than by sorting.
#include <string>
#include <vector>

#include "linalg/dense.hpp"
#include "linalg/subspace.hpp"
#include "pencil/band.hpp"
#include "tracking/family.hpp"

namespace squeal::tracking {

/// One friction of a followed sweep.
struct Station {
  double friction = 0;
  bool swept = true;                     ///< false: put in between to make sure of a continuation
  std::vector<linalg::DensePair> pairs;  ///< in the band or watched beside it, with left vectors
  std::vector<int> branch;               ///< [pair]
  std::vector<double> overlap;  ///< [pair] |tr(Π Π')| with the station before; 1 where a group was
                                ///< joined as a whole; 0: begins here
  std::vector<unsigned char> inBand;  ///< [pair]
};

/// A change of stability between two frictions.
struct Event {
  enum class Kind { coalescence, crossing, divergence } kind = Kind::crossing;
  int branch = 0, partner = -1;
  bool loss = true;          ///< stable below `high`'s side, unstable above
  double low = 0, high = 0;  ///< bracket; equal: at this friction itself, as where a double
                             ///< eigenvalue splits at once
  std::vector<linalg::DensePair> below, above;  ///< the pairs concerned at both ends
  double isolation = 0;                         ///< from other eigenvalues, rad/s
};

/// Where a continuation is not certain, and why.
struct Gap {
  double from = 0, to = 0;
  std::string what;
  bool identityOnly = false;  ///< all eigenvalues are accounted for; which is which is not
};

struct Branches {
  pencil::WatchedBand band;
  std::vector<Station> stations;  ///< ascending friction
  std::vector<Event> events;
  std::vector<Gap> gaps;
  int count = 0;              ///< of branches
  int entered = 0, left = 0;  ///< crossings of the edge of the band
  int inBandAt(const Station& station) const;
};

struct TrackLimits {
  /// Of a step of the sweep: steps with all eigenvalues are not halved further
  double smallest = 1. / 1024;
};

/// Collective. Follows all eigenvalues of the band over ascending frictions. A continuation is
/// certain where the spectral projectors of both ends have a trace of product close to the number
/// of eigenvalues joined; other steps are halved, for two eigenvalues that mix by their common
/// subspace alone, otherwise with all eigenvalues.
///
/// Where two neutral branches merge, the one of lower frequency becomes the growing one; where a
/// growing and a decaying one part, the growing one becomes the one of lower frequency: a
/// convention. Equal eigenvalues are numbered by frequency, then growth.
Branches follow(Family& family, const std::vector<double>& frictions,
                const pencil::WatchedBand& band, const TrackLimits& limits = {});

}  // namespace squeal::tracking
