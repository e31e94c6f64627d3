// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/flutter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/session/stages.hpp"
#include "eigen/stability/continuation.hpp"

namespace squeal::analysis {
namespace {

/// Returns the tracked line with these parameters; null if there is none.
stability::TrackedLine* lineOf(std::vector<sweep_solver::ModalSegment>& segments,
                               const sweep::Parameters& at) {
  for (auto& segment : segments)
    for (auto& tracked : segment.trackedLines) {
      sweep::Parameters line = tracked.line;
      line.friction = at.friction;
      if (line == at) return &tracked;
    }
  return nullptr;
}

/// Moves the tracked lines of new segments to the lines of `segments` that they continue.
void continueLines(std::vector<sweep_solver::ModalSegment>& segments,
                   std::vector<sweep_solver::ModalSegment>& added) {
  for (auto& segment : added) {
    std::vector<stability::TrackedLine> begun;
    for (auto& tracked : segment.trackedLines)
      if (auto* earlier = lineOf(segments, tracked.line))
        stability::append(*earlier, std::move(tracked));
      else {
        stability::nameMissingStart(tracked);
        begun.push_back(std::move(tracked));
      }
    segment.trackedLines = std::move(begun);
  }
}

}  // namespace

double Flutter::bandTop() const {
  double top = 0;
  for (const auto& segment : segments)
    for (const auto& point : segment.points) top = std::max(top, point.bandTop);
  return top > 0 ? top : INFINITY;
}

void Flutter::addFailure(MPI_Comm comm, const std::string& reason) {
  printWarning(comm, reason);
  failures.push_back(reason);
}

void Flutter::append(Flutter more) {
  const auto move = [](auto& from, auto& to) { std::ranges::move(from, std::back_inserter(to)); };
  continueLines(segments, more.segments);
  move(more.segments, segments);
  move(more.onsets, onsets);
  move(more.regimes, regimes);
  move(more.failures, failures);
  complete = more.complete;
}

}  // namespace squeal::analysis
