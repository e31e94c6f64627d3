// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/track.hpp"

#include <algorithm>
#include <cmath>
#include <list>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "eigen/tracking/join.hpp"
#include "eigen/tracking/screen.hpp"
#include "eigen/tracking/step.hpp"
#include "eigen/tracking/step_joiner.hpp"

namespace squeal::tracking {
namespace {

/// Tracks eigenvalues along a path, in batches of its frictions.
class Tracker {
 public:
  Tracker(const std::vector<Piece>& path, const pencil::WatchedBand& band,
          const TrackLimits& limits)
      : path_(path), limits_(limits) {
    result_.band = band;
  }

  Branches run() {
    std::list<SolvedStation> row;  // the last station already finished, and the next ones
    for (; piece_ < path_.size(); ++piece_) run(path_[piece_].frictions, row);
    return std::move(result_);
  }

 private:
  static constexpr std::size_t mostTogether = 4;  // stations whose matrices are in memory at a time

  Family& family() const { return *path_[piece_].family; }
  StepJoiner joiner() const { return {family(), result_.band}; }

  void run(const std::vector<double>& frictions, std::list<SolvedStation>& row) {
    const std::size_t together = std::min<std::size_t>(mpi::size(family().comm()), mostTogether);
    for (std::size_t first = 0; first < frictions.size(); first += together) {
      const std::vector<double> some(
          frictions.begin() + first,
          frictions.begin() + (std::min(first + together, frictions.size())));
      auto found = solve(some, true);
      for (std::size_t k = 0; k < some.size(); ++k) {
        if (!found[k]) {
          result_.gaps.push_back({some[k], some[k], "no reduced problem"});
          continue;
        }
        if (!row.empty())
          found[k]->smallest = limits_.smallest * (some[k] - row.back().station.friction);
        if (!row.empty() && row.back().station.piece != piece_) {
          const auto& last = row.back();
          found[k]->step = joiner().jump(*path_[last.station.piece].family, last, *found[k]);
          found[k]->whole = true;
        }
        row.push_back(std::move(*found[k]));
      }
      refine(row);
      const SolvedStation* last = nullptr;
      for (auto& next : row) {
        if (last || result_.stations.empty()) finish(last, next);
        last = &next;
      }
      if (!row.empty())
        family().progress(formatted("%d branches tracked to friction %g", result_.count,
                                    row.back().station.friction));
      if (!row.empty()) row.erase(row.begin(), std::prev(row.end()));
    }
  }

  /// Solves the problems at these frictions together, [friction]; none where there is no problem.
  std::vector<std::optional<SolvedStation>> solve(const std::vector<double>& frictions,
                                                  bool swept) {
    std::vector<linalg::DenseProblem> problems;
    std::vector<std::size_t> places;
    std::vector<double> solvable;
    for (std::size_t k = 0; k < frictions.size(); ++k)
      if (auto problem = family().at(frictions[k])) {
        problems.push_back(std::move(*problem));
        places.push_back(k);
        solvable.push_back(frictions[k]);
      }
    auto pairs = watchedPairs(family(), solvable, problems, result_.band);
    std::vector<std::optional<SolvedStation>> list(frictions.size());
    for (std::size_t i = 0; i < problems.size(); ++i) {
      Station station{.friction = frictions[places[i]],
                      .swept = swept,
                      .pairs = std::move(pairs[i]),
                      .piece = piece_};
      station.branch.assign(station.pairs.size(), -1);
      station.overlap.assign(station.pairs.size(), 0);
      for (const auto& pair : station.pairs)
        station.inBand.push_back(result_.band.contains(pair.s));
      linalg::Spectrum spectrum(problems[i], station.pairs);
      list[places[i]].emplace(
          SolvedStation{std::move(station), std::move(problems[i]), std::move(spectrum)});
    }
    return list;
  }

  /// Inserts frictions until all continuations are certain or the steps are too small. Solves the
  /// problems of a round together.
  void refine(std::list<SolvedStation>& row) {
    for (bool open = true; open;) {
      std::vector<std::list<SolvedStation>::iterator> places;
      std::vector<double> middles;
      for (auto a = row.begin(), b = row.begin(); a != row.end() && ++b != row.end(); a = b) {
        if (!b->step) b->step = joiner().join(*a, *b);
        if (b->step->sure || b->whole || b->station.friction - a->station.friction <= b->smallest)
          continue;
        places.push_back(b);
        middles.push_back(0.5 * (a->station.friction + b->station.friction));
      }
      auto found = solve(middles, false);
      for (std::size_t k = 0; k < places.size(); ++k) {
        SolvedStation& end = *places[k];
        if (found[k]) {
          found[k]->smallest = end.smallest;
          end.step.reset();
          row.insert(places[k], std::move(*found[k]));
        } else {
          end.whole = true;
          end.step->gaps.push_back({std::prev(places[k])->station.friction, end.station.friction,
                                    "no reduced problem in between"});
        }
      }
      open = !places.empty();
    }
  }

  /// Adds the result of the step from `a` to `b` (`a` is null for the first station), and numbers
  /// the branches that begin at `b`.
  void finish(const SolvedStation* a, SolvedStation& b) {
    if (a) {
      StepResult& step = *b.step;
      for (const auto& link : step.links) {
        b.station.branch[link.there] = a->station.branch[link.here];
        b.station.overlap[link.there] = link.overlap;
        result_.entered += !a->station.inBand[link.here] && b.station.inBand[link.there];
        result_.left += a->station.inBand[link.here] && !b.station.inBand[link.there];
      }
      // At a jump the problems at both ends have different unknowns, and there is no problem in
      // between.
      if (a->station.piece == b.station.piece)
        screen(family(), {a->station.friction, a->problem}, {b.station.friction, b.problem},
               step.singles, step.events, step.gaps);
      const auto number = [&](int index) { return index < 0 ? index : a->station.branch[index]; };
      for (auto& event : step.events) {
        event.branch = number(event.branch);
        event.partner = number(event.partner);
        event.piece = piece_;
        result_.events.push_back(std::move(event));
      }
      for (auto& gap : step.gaps) result_.gaps.push_back(std::move(gap));
      b.step.reset();
    }
    for (int& branch : b.station.branch)
      if (branch < 0) branch = result_.count++;
    result_.stations.push_back(b.station);
  }

  const std::vector<Piece>& path_;
  std::size_t piece_ = 0;  // of the path
  TrackLimits limits_;
  Branches result_;
};

}  // namespace

int Branches::inBandAt(const Station& station) const {
  return std::ranges::count(station.inBand, 1);
}

Branches track(const std::vector<Piece>& path, const pencil::WatchedBand& band,
               const TrackLimits& limits) {
  return Tracker(path, band, limits).run();
}

Branches track(Family& family, const std::vector<double>& frictions,
               const pencil::WatchedBand& band, const TrackLimits& limits) {
  return track({{&family, frictions}}, band, limits);
}

}  // namespace squeal::tracking
