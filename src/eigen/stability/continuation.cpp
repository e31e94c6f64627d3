// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/stability/continuation.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <iterator>
#include <map>
#include <string>

#include "base/system/text.hpp"
#include "eigen/tracking/growth.hpp"

namespace squeal::stability {
namespace {

/// Largest difference of an eigenvalue in the bands of both bases, relative to |s|. Both are
/// corrected to smaller errors; one that is not is named, not joined.
constexpr double near = 1e-5;
/// The same if it is only watched in one of the bases, which is then not corrected for it.
constexpr double nearWatched = 1e-3;
/// Eigenvalues are equal up to this difference, relative to |s|, as in coincide().
constexpr double rounding = 1e-7;

constexpr std::size_t none = -1;

/// The eigenvalues of two bases at the same friction.
struct Match {
  std::vector<std::size_t> mate;       ///< [pair of the later basis] that of the earlier one
  std::vector<unsigned char> hasMate;  ///< [pair of the earlier basis]
  std::size_t uncertain = 0;           ///< number of second candidates for pairs of the bands
  double uncertainNear = 0;            ///< imaginary part of one of them, rad/s
};

struct Candidate {
  double distance;
  std::size_t later, earlier;
  auto operator<=>(const Candidate&) const = default;
};

std::vector<Candidate> candidates(const Station& earlier, const Station& later) {
  std::vector<Candidate> found;
  for (std::size_t j = 0; j < later.pairs.size(); ++j)
    for (std::size_t i = 0; i < earlier.pairs.size(); ++i) {
      const double distance = std::abs(later.pairs[j].s - earlier.pairs[i].s),
                   limit = later.inBand[j] && earlier.inBand[i] ? near : nearWatched;
      if (distance <= limit * std::abs(later.pairs[j].s)) found.push_back({distance, j, i});
    }
  std::ranges::sort(found);
  return found;
}

bool areEqual(const Station& station, std::size_t a, std::size_t b) {
  const Complex s = station.pairs[a].s;
  return std::abs(s - station.pairs[b].s) <= rounding * std::abs(s);
}

/// Assigns equal eigenvalues in the order of the numbers of their branches, since their distances
/// are round-off.
void orderEqual(const Station& earlier, const Station& later, Match& match) {
  for (std::size_t first = 0; first < match.mate.size(); ++first) {
    if (match.mate[first] == none) continue;
    std::vector<std::size_t> here, there;
    for (std::size_t j = 0; j < match.mate.size(); ++j)
      if (match.mate[j] != none && areEqual(earlier, match.mate[first], match.mate[j]))
        here.push_back(j), there.push_back(match.mate[j]);
    if (here.size() == 1 || here.front() != first) continue;
    std::ranges::sort(here, {}, [&](std::size_t j) { return later.branch[j]; });
    std::ranges::sort(there, {}, [&](std::size_t i) { return earlier.branch[i]; });
    for (std::size_t k = 0; k < here.size(); ++k) match.mate[here[k]] = there[k];
  }
}

/// Assigns the eigenvalues of two stations to each other, in the order of ascending distance.
Match matched(const Station& earlier, const Station& later) {
  const auto list = candidates(earlier, later);
  Match match{.mate = std::vector<std::size_t>(later.pairs.size(), none),
              .hasMate = std::vector<unsigned char>(earlier.pairs.size(), 0)};
  std::vector<double> own(later.pairs.size(), 0);  // [pair] distance from its mate
  for (const auto& [distance, j, i] : list)
    if (match.mate[j] == none && !match.hasMate[i]) {
      match.mate[j] = i;
      match.hasMate[i] = 1;
      own[j] = distance;
    }
  for (const auto& [distance, j, i] : list)
    if (match.mate[j] != none && match.mate[j] != i && distance <= 10 * own[j] &&
        (later.inBand[j] || earlier.inBand[i]) && !areEqual(earlier, match.mate[j], i)) {
      ++match.uncertain;
      match.uncertainNear = later.pairs[j].s.imag();
    }
  orderEqual(earlier, later, match);
  return match;
}

/// Returns what differs between two bases at the same friction, in the part of the plane that is in
/// both bands; empty if nothing does.
std::string difference(const Branches& before, const Branches& after, const Match& match,
                       bool damped) {
  const Station &earlier = before.stations.back(), &later = after.stations.front();
  std::ptrdiff_t added = 0, lost = 0, changed = 0;
  for (std::size_t j = 0; j < later.pairs.size(); ++j) {
    if (!later.inBand[j]) continue;
    if (const std::size_t i = match.mate[j]; i != none)
      changed += tracking::changes(tracking::sign(earlier.pairs[i].s, damped),
                                   tracking::sign(later.pairs[j].s, damped));
    else
      added += before.band.contains(later.pairs[j].s);
  }
  for (std::size_t i = 0; i < earlier.pairs.size(); ++i)
    lost += earlier.inBand[i] && !match.hasMate[i] && after.band.contains(earlier.pairs[i].s);
  if (added + lost + changed == 0) return {};
  return formatted(
      "of the eigenvalues at this friction in two bases, %td are only in the first, %td only in "
      "the second, and %td are unstable in one of them",
      lost, added, changed);
}

/// Joins two lines at the same friction. Adds to `before` what is not certain, and the eigenvalues
/// that enter or leave the band because the two bands differ.
Match joined(Branches& before, const Branches& after, bool damped) {
  const Station &last = before.stations.back(), &first = after.stations.front();
  Match match = matched(last, first);
  std::vector<unsigned char> stays(last.pairs.size(), 0);
  for (std::size_t j = 0; j < first.pairs.size(); ++j) {
    const std::size_t i = match.mate[j];
    before.entered += first.inBand[j] && (i == none || !last.inBand[i]);
    if (i != none) stays[i] = first.inBand[j];
  }
  for (std::size_t i = 0; i < last.pairs.size(); ++i) before.left += last.inBand[i] && !stays[i];
  const double f = first.friction;
  if (auto text = difference(before, after, match, damped); !text.empty())
    before.gaps.push_back({f, f, std::move(text)});
  if (match.uncertain > 0)
    before.gaps.push_back({f, f,
                           formatted("%zu assignments of eigenvalues of two bases are uncertain, "
                                     "near %.6g Hz",
                                     match.uncertain, match.uncertainNear / (2 * M_PI)),
                           true});
  return match;
}

/// Returns the new numbers of the branches of `after` [its number]: those of the branches that
/// they continue at `station`, if given, or the next ones after `count`, which is raised.
std::map<int, int> numbersOf(const Branches& after, const Station* station, const Match& match,
                             int& count) {
  std::map<int, int> numbers{{0, 0}};  // 0: never in the band
  if (station)
    for (std::size_t j = 0; j < match.mate.size(); ++j)
      if (const int branch = after.stations.front().branch[j];
          match.mate[j] != none && station->branch[match.mate[j]] > 0)
        numbers.try_emplace(branch, station->branch[match.mate[j]]);
  std::map<int, int> fresh;
  for (const auto& one : after.stations)
    for (const int branch : one.branch)
      if (!numbers.contains(branch)) fresh.try_emplace(branch, 0);
  for (auto& [branch, number] : fresh) number = ++count;
  numbers.merge(fresh);
  return numbers;
}

/// Omits what a line contains below a friction.
void omitBelow(TrackedLine& line, double friction) {
  Branches& branches = line.branches;
  std::erase_if(branches.stations,
                [&](const Station& station) { return station.friction < friction; });
  std::erase_if(branches.gaps, [&](const Gap& gap) { return gap.to < friction; });
  std::erase_if(line.unlocated, [&](const auto& step) { return step.first < friction; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < line.criticals.size(); ++i) {
    if (line.criticals[i].friction < friction) continue;
    line.criticals[kept] = line.criticals[i];
    line.criticalModes[kept++] = std::move(line.criticalModes[i]);
  }
  line.criticals.resize(kept);
  line.criticalModes.resize(kept);
  branches.entered = branches.left = branches.omitted = 0;
  for (std::size_t k = 1; k < branches.stations.size(); ++k) {
    const Station &a = branches.stations[k - 1], &b = branches.stations[k];
    if (b.piece > a.piece + 1) branches.omitted += b.piece - a.piece - 1;
    std::map<int, bool> was;
    for (std::size_t i = 0; i < a.pairs.size(); ++i)
      if (a.branch[i] > 0) was[a.branch[i]] = a.inBand[i];
    for (std::size_t j = 0; j < b.pairs.size(); ++j)
      if (const auto known = was.find(b.branch[j]); known != was.end()) {
        branches.entered += !known->second && b.inBand[j];
        branches.left += known->second && !b.inBand[j];
      }
  }
}

/// Makes the part between two lines one gap, unless it is one already.
void addGap(double end, TrackedLine& later) {
  const double begin =
      later.branches.stations.empty() ? later.begin : later.branches.stations.front().friction;
  auto& gaps = later.branches.gaps;
  const auto isNamed = [&](const Gap& gap) {
    return !gap.identityOnly && gap.from <= end && gap.to >= begin;
  };
  if (std::ranges::any_of(gaps, isNamed)) return;
  std::erase_if(gaps, [&](const Gap& gap) { return gap.from >= end && gap.to <= begin; });
  gaps.insert(gaps.begin(), {end, begin, "not tracked between these frictions"});
}

/// Gives the branches and pieces of a line new numbers.
void renumber(const std::map<int, int>& numbers, std::size_t pieces, TrackedLine& line) {
  const auto numberOf = [&](int branch) {
    const auto known = numbers.find(branch);
    return known == numbers.end() ? 0 : known->second;
  };
  for (auto& station : line.branches.stations) {
    for (int& branch : station.branch) branch = numberOf(branch);
    station.piece += pieces;
  }
  for (auto& critical : line.criticals) {
    critical.branch = numberOf(critical.branch);
    critical.partner = numberOf(critical.partner);
    critical.piece += pieces;
  }
}

}  // namespace

void append(TrackedLine& earlier, TrackedLine later) {
  Branches &before = earlier.branches, &after = later.branches;
  if (before.stations.empty()) {
    nameMissingStart(later);
    after.gaps.insert(after.gaps.begin(), before.gaps.begin(), before.gaps.end());
    earlier = std::move(later);
    return;
  }
  const double end = before.stations.back().friction;
  if (!later.continues) omitBelow(later, later.begin);
  const bool isShared =
      later.continues && !after.stations.empty() && after.stations.front().friction == end;
  Match match;
  if (isShared)
    match = joined(before, after, later.isDamped);
  else
    addGap(end, later);
  renumber(numbersOf(after, isShared ? &before.stations.back() : nullptr, match, before.count),
           earlier.activeSet.size() - (isShared ? 1 : 0), later);
  if (isShared) {
    after.stations.erase(after.stations.begin());
    later.activeSet.erase(later.activeSet.begin());
  }
  const auto move = [](auto& from, auto& to) { std::ranges::move(from, std::back_inserter(to)); };
  move(later.activeSet, earlier.activeSet);
  move(after.stations, before.stations);
  move(after.gaps, before.gaps);
  move(later.unlocated, earlier.unlocated);
  move(later.criticals, earlier.criticals);
  move(later.criticalModes, earlier.criticalModes);
  before.entered += after.entered;
  before.left += after.left;
  before.omitted += after.omitted;
  earlier.isContinued = later.isContinued;
  earlier.wholeSpace = earlier.wholeSpace && later.wholeSpace;
}

void nameMissingStart(TrackedLine& line) {
  const bool isFromZero =
      !line.branches.stations.empty() && line.branches.stations.front().friction == 0;
  if (line.continues && !isFromZero) addGap(0, line);
}

void nameMissingEnd(TrackedLine& line, double last) {
  const auto& stations = line.branches.stations;
  if (line.isContinued && !stations.empty() && stations.back().friction < last)
    line.branches.gaps.push_back({stations.back().friction, last, "not tracked beyond"});
}

}  // namespace squeal::stability
