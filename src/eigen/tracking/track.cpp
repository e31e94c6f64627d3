// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/track.hpp"

#include <algorithm>
#include <cmath>
#include <list>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "eigen/tracking/join.hpp"
#include "eigen/tracking/neutral_end.hpp"
#include "eigen/tracking/screen.hpp"
#include "eigen/tracking/step.hpp"
#include "eigen/tracking/step_joiner.hpp"

namespace squeal::tracking {
namespace {

/// A friction of a piece of the path.
struct Place {
  std::size_t piece;
  double friction;
  bool needed;
};

/// Returns the frictions of all pieces of a path. Those that may be omitted are needed if the
/// problems are affine, or if there are at most `examined` of them between two needed ones.
std::vector<Place> placesOf(const std::vector<Piece>& path, std::size_t examined) {
  std::vector<Place> places;
  for (std::size_t p = 0; p < path.size(); ++p)
    for (std::size_t k = 0; k < path[p].frictions.size(); ++k)
      places.push_back({p, path[p].frictions[k], path[p].needed.empty() || path[p].needed[k] != 0});
  if (places.empty()) return places;
  places.front().needed = places.back().needed = true;
  if (std::ranges::all_of(path, [](const Piece& piece) { return piece.family->isAffine(); }))
    examined = places.size();
  for (std::size_t from = 0, to = 0; from + 1 < places.size(); from = to) {
    for (to = from + 1; !places[to].needed;) ++to;
    if (to - from - 1 <= examined)
      for (std::size_t k = from + 1; k < to; ++k) places[k].needed = true;
  }
  return places;
}

/// Tracks eigenvalues along a path, in batches of its frictions.
class Tracker {
 public:
  Tracker(const std::vector<Piece>& path, const pencil::WatchedBand& band,
          const TrackLimits& limits)
      : path_(path),
        places_(placesOf(path, limits.examined)),
        limits_(limits),
        comm_(path.front().family->comm()),
        together_(std::min<std::size_t>(2 * mpi::size(comm_), mostTogether)) {
    result_.band = band;
  }

  Branches run() {
    std::list<SolvedStation> row;  // the last station already finished, and the next ones
    std::vector<Wanted> some;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      if (places_[k].needed) some.push_back(wantedAt(k));
      if (some.size() < together_ && k + 1 < places_.size()) continue;
      append(some, row);
      some.clear();
      if (row.empty()) continue;
      if (result_.stations.empty()) finish(nullptr, row.front());
      refine(row);
      familyOf(row.back().station.piece)
          .progress(formatted("%d branches tracked to friction %g", result_.count,
                              row.back().station.friction));
    }
    bracketNeutralEnds(path_, result_);
    return std::move(result_);
  }

 private:
  static constexpr std::size_t mostTogether = 8;  // stations whose matrices are in memory at a time

  /// A station to be solved.
  struct Wanted {
    std::size_t piece;
    double friction;
    std::size_t place;
    double smallest;
    bool swept;
  };

  Wanted wantedAt(std::size_t place) const {
    const auto& [piece, friction, needed] = places_[place];
    const double step = place == 0 ? 0 : friction - places_[place - 1].friction;
    return {piece, friction, place, limits_.smallest * step, true};
  }
  Family& familyOf(std::size_t piece) const { return *path_[piece].family; }

  void append(const std::vector<Wanted>& some, std::list<SolvedStation>& row) {
    auto found = solve(some);
    for (std::size_t k = 0; k < some.size(); ++k)
      if (found[k])
        row.push_back(std::move(*found[k]));
      else
        result_.gaps.push_back({some[k].friction, some[k].friction, "no reduced problem"});
  }

  /// Solves these problems together; none where the family has no problem.
  std::vector<std::optional<SolvedStation>> solve(const std::vector<Wanted>& some) {
    std::vector<std::optional<linalg::DenseProblem>> problems;
    std::vector<ProblemAt> solvable;
    std::vector<std::size_t> which;
    for (const auto& wanted : some) problems.push_back(familyOf(wanted.piece).at(wanted.friction));
    for (std::size_t k = 0; k < some.size(); ++k)
      if (problems[k]) {
        solvable.push_back({&familyOf(some[k].piece), some[k].friction, &*problems[k]});
        which.push_back(k);
      }
    auto pairs = watchedPairs(comm_, solvable, result_.band);
    std::vector<std::optional<SolvedStation>> list(some.size());
    for (std::size_t i = 0; i < which.size(); ++i) {
      const Wanted& wanted = some[which[i]];
      Station station{.friction = wanted.friction,
                      .swept = wanted.swept,
                      .pairs = std::move(pairs[i]),
                      .piece = wanted.piece};
      station.branch.assign(station.pairs.size(), -1);
      station.overlap.assign(station.pairs.size(), 0);
      for (const auto& pair : station.pairs)
        station.inBand.push_back(result_.band.contains(pair.s));
      linalg::Spectrum spectrum(*problems[which[i]], station.pairs);
      list[which[i]].emplace(SolvedStation{.station = std::move(station),
                                           .problem = std::move(*problems[which[i]]),
                                           .spectrum = std::move(spectrum),
                                           .smallest = wanted.smallest,
                                           .place = wanted.place});
    }
    return list;
  }

  /// Returns true if no station is to be inserted between `a` and `b`, which are joined.
  static bool isSettled(const SolvedStation& a, const SolvedStation& b) {
    const StepResult& step = *b.step;
    if (b.whole) return true;
    if (a.station.piece == b.station.piece)
      return step.sure || b.station.friction - a.station.friction <= b.smallest;
    return b.place - a.place <= 1 || (step.sure && step.events.empty());
  }
  Wanted middleOf(const SolvedStation& a, const SolvedStation& b) const {
    if (a.station.piece == b.station.piece)
      return {a.station.piece, 0.5 * (a.station.friction + b.station.friction), a.place, b.smallest,
              false};
    return wantedAt((a.place + b.place) / 2);
  }
  void join(const SolvedStation& a, SolvedStation& b) const {
    if (b.step) return;
    const std::size_t from = a.station.piece, to = b.station.piece;
    const StepJoiner joiner(familyOf(to), result_.band);
    b.step = from == to ? joiner.join(a, b) : joiner.jump(familyOf(from), a, b);
  }

  /// Finishes all steps of the row. Inserts stations until all continuations are certain or cannot
  /// be divided. Solves some of them together, those of the lowest frictions first, so that few
  /// stations are in memory.
  void refine(std::list<SolvedStation>& row) {
    while (row.size() > 1) {
      std::vector<std::list<SolvedStation>::iterator> ends;
      std::vector<Wanted> middles;
      for (auto a = row.begin(), b = std::next(a); b != row.end() && ends.size() < together_;
           a = b++) {
        join(*a, *b);
        if (!isSettled(*a, *b)) {
          ends.push_back(b);
          middles.push_back(middleOf(*a, *b));
        } else if (ends.empty()) {
          finish(&*a, *b);
          row.erase(a);
        }
      }
      auto found = solve(middles);
      for (std::size_t k = 0; k < ends.size(); ++k) {
        SolvedStation& end = *ends[k];
        if (found[k]) {
          end.step.reset();
          row.insert(ends[k], std::move(*found[k]));
        } else {
          end.whole = true;
          end.step->gaps.push_back({std::prev(ends[k])->station.friction, end.station.friction,
                                    "no reduced problem in between"});
        }
      }
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
        screen(familyOf(b.station.piece), {a->station.friction, a->problem},
               {b.station.friction, b.problem}, step.singles, step.events, step.gaps);
      const auto number = [&](int index) { return index < 0 ? index : a->station.branch[index]; };
      for (auto& event : step.events) {
        event.branch = number(event.branch);
        event.partner = number(event.partner);
        event.piece = b.station.piece;
        result_.events.push_back(std::move(event));
      }
      for (auto& gap : step.gaps) result_.gaps.push_back(std::move(gap));
      b.step.reset();
      if (b.station.piece > a->station.piece + 1)
        result_.omitted += b.station.piece - a->station.piece - 1;
    }
    for (int& branch : b.station.branch)
      if (branch < 0) branch = result_.count++;
    result_.stations.push_back(withoutVectors(b.station));
  }

  /// The vectors of hundreds of stations would take more memory than the basis.
  static Station withoutVectors(const Station& station) {
    Station result{.friction = station.friction,
                   .swept = station.swept,
                   .pairs = {},
                   .branch = station.branch,
                   .overlap = station.overlap,
                   .inBand = station.inBand,
                   .piece = station.piece};
    for (const auto& pair : station.pairs) result.pairs.push_back({pair.s, {}});
    return result;
  }

  const std::vector<Piece>& path_;
  std::vector<Place> places_;
  TrackLimits limits_;
  MPI_Comm comm_;
  std::size_t together_;
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
