// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/stability/critical.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/spread.hpp"
#include "base/petsc/check.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/stability/critical_root.hpp"

namespace squeal::stability {

using tracking::PairsAtFriction;

namespace {

/// Removes pairs of coalescences of the same eigenvalues that cancel within their errors from a
/// list, ordered by friction: the eigenvalues cross, and the growth in between is round-off.
void removeTouching(std::vector<Critical>& list) {
  for (auto one = list.begin(); one != list.end();) {
    const auto undoes = [&](const Critical& other) {
      return other.kind == one->kind && other.loss != one->loss && other.piece == one->piece &&
             std::minmax(other.branch, other.partner) == std::minmax(one->branch, one->partner);
    };
    const auto next = std::find_if(one + 1, list.end(), undoes);
    const bool isRounding =
        one->kind == Event::Kind::coalescence && next != list.end() && one->converged &&
        next->converged &&
        next->friction - one->friction <= one->errorEstimate + next->errorEstimate;
    if (!isRounding) {
      ++one;
      continue;
    }
    list.erase(next);
    one = list.erase(one);
  }
}

/// The searches for all events, distributed over the ranks.
class Roots {
 public:
  Roots(Family& family, const std::vector<Event>& events, double tolerance)
      : family_(family), rank_(mpi::rank(family.comm())), ranks_(mpi::size(family.comm())) {
    std::vector<double> ends;
    for (const auto& event : events) {
      roots_.emplace_back(event, tolerance);
      if (event.kind == Event::Kind::contact ? event.low == event.high : event.low < event.high)
        ends.insert(ends.end(), {event.low, event.high});
    }
    family.addFrictions(ends);
    locate(indices(events.size()), true);
  }

  /// Returns the indices of the unsettled events.
  std::vector<std::size_t> open() const {
    std::vector<int> is(roots_.size(), 0);
    for (std::size_t i = 0; i < roots_.size(); ++i) is[i] = mine(i) && !roots_[i].settled() ? 1 : 0;
    return selected(std::move(is));
  }

  /// Improves the basis for these events and locates them again. Returns false if the basis has not
  /// changed.
  bool improve(const std::vector<std::size_t>& open) {
    const reduction::Improvement improvement = family_.improve(located(open));
    setErrors(open, improvement);
    locate(open, improvement.changed);
    return improvement.changed;
  }

  /// Sets the errors of the eigenvalues as they were located last.
  void measure() {
    std::vector<int> is(roots_.size(), 0);
    for (std::size_t i = 0; i < roots_.size(); ++i) is[i] = mine(i) && roots_[i].found() ? 1 : 0;
    const auto found = selected(std::move(is));
    setErrors(found, family_.errorsOf(located(found)));
  }

  std::vector<Critical> results() const {
    std::vector<Critical> list(roots_.size());
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      if (mine(i)) list[i] = roots_[i].result();
      mpi::broadcast(family_.comm(), list[i], owner(i));
    }
    return list;
  }

 private:
  static std::vector<std::size_t> indices(std::size_t count) {
    std::vector<std::size_t> list(count);
    std::iota(list.begin(), list.end(), 0);
    return list;
  }
  /// Collective. Returns the indices of the events that their owners have marked.
  std::vector<std::size_t> selected(std::vector<int> is) const {
    mpi::reduce(family_.comm(), std::span(is), MPI_MAX);
    auto list = indices(roots_.size());
    std::erase_if(list, [&](auto i) { return is[i] == 0; });
    return list;
  }
  /// Collective. Returns the eigenpairs of these events.
  std::vector<PairsAtFriction> located(const std::vector<std::size_t>& events) const {
    std::vector<PairsAtFriction> list;
    for (const auto i : events) {
      PairsAtFriction item = mine(i) ? roots_[i].located() : PairsAtFriction{};
      mpi::broadcast(family_.comm(), item.friction, owner(i));
      linalg::shareFrom(owner(i), family_.comm(), item.pairs, linalg::Vectors::both);
      list.push_back(std::move(item));
    }
    return list;
  }
  /// Sets the errors of these events; none are known in the full problem.
  void setErrors(const std::vector<std::size_t>& events, const reduction::Improvement& errors) {
    for (std::size_t k = 0; k < errors.backwardError.size(); ++k)
      roots_[events[k]].setErrors(errors.backwardError[k], errors.roundOff[k]);
  }
  int owner(std::size_t i) const { return i % ranks_; }
  bool mine(std::size_t i) const { return owner(i) == rank_; }

  void locate(const std::vector<std::size_t>& open, bool changed) {
    std::string failure;
    for (const auto i : open)
      if (mine(i) && failure.empty()) try {
          roots_[i].locate(family_, changed);
        } catch (const Error& error) {
          failure = error.what();
        }
    failTogether(family_.comm(), failure);
  }

  Family& family_;
  int rank_, ranks_;
  std::vector<CriticalRoot> roots_;
};

}  // namespace

std::vector<Critical> criticalFrictions(const std::vector<Piece>& path, const Branches& branches,
                                        double tolerance) {
  constexpr int rounds = 10;
  // Locate all events before the basis grows beyond the basis of their vectors.
  std::vector<std::vector<Event>> events(path.size());
  std::vector<std::unique_ptr<Roots>> pieces(path.size());  // null without events
  for (const auto& event : branches.events) events[event.piece].push_back(event);
  for (std::size_t piece = 0; piece < path.size(); ++piece) {
    if (events[piece].empty()) continue;
    pieces[piece] = std::make_unique<Roots>(*path[piece].family, events[piece], tolerance);
  }
  std::vector<Critical> list;
  for (std::size_t piece = 0; piece < path.size(); ++piece) {
    if (!pieces[piece]) continue;
    Roots& roots = *pieces[piece];
    for (int round = 0; round < rounds; ++round) {
      const auto open = roots.open();
      path[piece].family->progress(formatted("%zu of %zu critical frictions to be improved",
                                             open.size(), events[piece].size()));
      if (open.empty() || !roots.improve(open)) break;
    }
    roots.measure();
    for (auto& found : roots.results()) list.push_back(std::move(found));
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.friction < b.friction; });
  removeTouching(list);
  return list;
}

std::vector<Critical> criticalFrictions(Family& family, const Branches& branches,
                                        double tolerance) {
  return criticalFrictions(std::vector<Piece>{{&family, {}}}, branches, tolerance);
}

}  // namespace squeal::stability
