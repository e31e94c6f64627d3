// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/sweep_lines.hpp"

#include <algorithm>
#include <iterator>

#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep_solver/critical_modes.hpp"

namespace squeal::sweep_solver {
namespace {

/// Returns the number of an active set in the results; 0 if it occurs only between points.
int numberOf(const SweepProblem& problem, std::size_t range) {
  if (problem.ranges[range].isPassed()) return 0;
  // Ranges that contain only a point of the preceding problem are counted there.
  const auto hasOwn = [&](const PointRange& one) {
    return one.last > std::max<std::size_t>(one.first, problem.continues ? 1 : 0);
  };
  const auto begin = problem.ranges.begin();
  return problem.rangesBefore + int(std::count_if(begin, begin + range + 1, hasOwn));
}

}  // namespace

std::vector<LineOfSegment> linesOf(const SweepProblem& problem, const SweepPlan& plan,
                                   const SweepState& state, const SourceOfRange& sourceOf) {
  std::vector<LineOfSegment> found;
  for (std::size_t first = 0, last = 0; first < plan.points.size(); first = last) {
    stability::Line line;
    line.at = plan.points[first];
    line.modes = &state.segments[plan.places[first].range].modes;
    do {
      line.swept.push_back(plan.points[last++].friction);
    } while (last < plan.points.size() &&
             sweep::growsInFriction(plan.points[last - 1], plan.points[last]));
    line.at.friction = 0;
    const std::size_t from = plan.places[first].steadyPoint;
    line.continues = !plan.places[first].isOwn;
    if (from == 0 && problem.frictionBefore) {
      line.before = problem.frictionBefore;
      line.whyNotFollowed =
          "no basis serves the active sets of both frictions (" + problem.whyNoBasis + ")";
    } else if (from < problem.whyNotFromZero.size() && !problem.whyNotFromZero[from].empty() &&
               !line.continues) {
      line.before = 0;
      line.whyNotFollowed = problem.whyNotFromZero[from];
    }
    line.isContinued =
        problem.isContinued && plan.places[last - 1].steadyPoint + 1 == problem.steadyPoints.size();
    for (const auto& piece : problem.path(from, last - first)) {
      line.pieces.push_back(
          {sourceOf(*piece.range), {piece.from}, numberOf(problem, *piece.range), *piece.range});
      auto& frictions = line.pieces.back().frictions;
      for (double friction : line.swept)
        if (piece.from < friction && friction < piece.to) frictions.push_back(friction);
      if (piece.to > piece.from) frictions.push_back(piece.to);
    }
    // A line that continues another has a second point, which is its first with results here.
    const std::size_t own = first + (line.continues ? 1 : 0);
    found.push_back({std::move(line), plan.places[own].range});
  }
  return found;
}

std::vector<stability::TrackedLine> trackedLines(SweepProblem& problem,
                                                 reduction::ReducedProblem& reduced,
                                                 const std::vector<stability::Line>& lines,
                                                 const Settings& settings) {
  const MPI_Comm comm = reduced.basis().comm();
  Stage stage(comm, "track");
  const auto progress = [&](const std::string& text) {
    stage.progress(text);
    stopIfRequested(comm);
  };
  auto tracked = stability::trackLines(reduced, lines, settings.stability, comm, progress);
  std::size_t branches = 0, stations = 0, criticals = 0;
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    addCriticalModes(problem, reduced, lines[i], settings.sensitivity.wanted, progress, tracked[i]);
    branches += tracked[i].branches.count;
    stations += tracked[i].branches.stations.size();
    criticals += tracked[i].criticals.size();
  }
  stage.finish(
      formatted("%zu branches tracked over %zu frictions, %zu critical frictions, basis of "
                "%" PetscInt_FMT,
                branches, stations, criticals, reduced.basisSize()));
  return tracked;
}

void keepTrackedLines(std::vector<ModalSegment>& segments) {
  const auto begin = segments.begin();
  for (auto segment = begin; segment != segments.end(); ++segment) {
    if (segment->trackedLines.empty() || hasResults(*segment)) continue;
    auto next = std::find_if(segment, segments.end(), hasResults);
    if (next == segments.end()) next = std::find_if(begin, segment, hasResults);
    if (next == segment) return;  // none has results
    std::ranges::move(segment->trackedLines, std::back_inserter(next->trackedLines));
    segment->trackedLines.clear();
  }
}

}  // namespace squeal::sweep_solver
