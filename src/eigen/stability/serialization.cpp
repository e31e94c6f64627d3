// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/stability/serialization.hpp"

#include "eigen/pencil/serialization.hpp"

namespace squeal::tracking {

/// The streams find these by argument-dependent lookup.
void fields(Stream& stream, Station& station);
void fields(Stream& stream, Event& event);
void fields(Stream& stream, Gap& gap);

// These list all members: a new one does not compile until it is added here.

void fields(Stream& stream, Station& station) {
  auto& [friction, swept, pairs, branch, overlap, inBand, piece] = station;
  stream(friction, swept, pairs, branch, overlap, inBand, piece);
}

void fields(Stream& stream, Event& event) {
  auto& [kind, branch, partner, loss, low, high, below, above, isolation, piece] = event;
  stream(kind, branch, partner, loss, low, high, below, above, isolation, piece);
}

void fields(Stream& stream, Gap& gap) {
  auto& [from, to, what, identityOnly] = gap;
  stream(from, to, what, identityOnly);
}

}  // namespace squeal::tracking

namespace squeal::stability {

void fields(Stream& stream, TrackedLine& tracked) {
  auto& [line, activeSet, from, begin, continues, isContinued, branches, criticals, modes,
         countExact, wholeSpace, isDamped, unlocated] = tracked;
  auto& [band, stations, events, gaps, count, entered, left, omitted] = branches;
  stream(line, activeSet, from, begin, continues, isContinued, band, stations, events, gaps, count,
         entered, left, omitted, criticals, modes, countExact, wholeSpace, isDamped, unlocated);
}

}  // namespace squeal::stability
