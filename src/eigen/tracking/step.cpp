// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/step.hpp"

#include <cmath>

#include "base/system/text.hpp"
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
    event.high = event.low, event.above = event.below;
  else if (after == 0)
    event.low = event.high, event.below = event.above;
  return event;
}

Event splitting(Event event, bool loss, bool atLow) {
  event.kind = Event::Kind::coalescence;
  event.loss = loss;
  (atLow ? event.high : event.low) = atLow ? event.low : event.high;
  (atLow ? event.above : event.below) = atLow ? event.below : event.above;
  return event;
}

Gap notExamined(double low, double high, const std::vector<linalg::DensePair>& pairs) {
  return {low, high,
          formatted("%s near %.6g Hz could not be examined in between",
                    pairs.size() == 1 ? "an eigenvalue" : "eigenvalues",
                    mean(pairs).imag() / (2 * M_PI))};
}

}  // namespace squeal::tracking
