// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/step.hpp"

#include "eigen/tracking/growth.hpp"
#include "eigen/tracking/join.hpp"

namespace squeal::tracking {

std::optional<Event> crossing(Event event, int before, int after) {
  if (!changes(before, after)) return {};  // between neutral and decaying: stable on both sides
  event.kind = Event::Kind::crossing;
  event.loss = after > before;
  if (real(event.below[0].s) || real(event.above[0].s))
    event.kind = Event::Kind::divergence;
  else if (before == 0)
    event.high = event.low;
  else if (after == 0)
    event.low = event.high, event.below = event.above;
  return event;
}

Event splitting(Event event, bool loss, double friction) {
  event.kind = Event::Kind::coalescence;
  event.loss = loss;
  event.low = event.high = friction;
  return event;
}

}  // namespace squeal::tracking
