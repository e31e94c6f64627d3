#include "stability/kept.hpp"

namespace squeal::tracking {

/// The streams find these by their arguments.
void fields(checkpoint::Stream& stream, Station& station);
void fields(checkpoint::Stream& stream, Event& event);
void fields(checkpoint::Stream& stream, Gap& gap);

void fields(checkpoint::Stream& stream, Station& station) {
  stream(station.friction, station.swept, station.pairs, station.branch, station.overlap,
         station.inBand, station.piece);
}

void fields(checkpoint::Stream& stream, Event& event) {
  stream(event.kind, event.branch, event.partner, event.loss, event.low, event.high, event.below,
         event.above, event.isolation, event.piece);
}

void fields(checkpoint::Stream& stream, Gap& gap) {
  stream(gap.from, gap.to, gap.what, gap.identityOnly);
}

}  // namespace squeal::tracking

namespace squeal::stability {

void fields(checkpoint::Stream& stream, Followed& followed) {
  auto& branches = followed.branches;
  stream(followed.line, followed.activeSet, followed.from, branches.band, branches.stations,
         branches.events, branches.gaps, branches.count, branches.entered, branches.left,
         followed.criticals, followed.countExact, followed.wholeSpace);
}

}  // namespace squeal::stability
