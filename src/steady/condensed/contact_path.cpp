// SPDX-License-Identifier: BSD-2-Clause
#include "steady/condensed/contact_path.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <optional>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"
#include "steady/condensed/path_states.hpp"

namespace squeal::condensed {
namespace {

/// A force below minus this fraction of the largest force is tensile. A gap overlaps if the force
/// that would open it as far is below the same bound. Smaller values are round-off.
constexpr double rounding = 1e-9;
/// The length of the line after an event on which the new active set must be consistent.
constexpr double behind = 1e-7;
/// The largest number of changes at one place before SNES finds the new set.
constexpr int mostTogether = 32;

/// The point where a force or a gap changes its sign.
struct SignChange {
  double at;                   ///< a point shortly below, if the sign changes through infinity
  std::optional<double> pole;  ///< place of the pole
};

/// Returns the pole of a function from four points near it: the value at y = 0 of the polynomial
/// through the points as a function of the reciprocals y.
double poleNear(const std::array<double, 4>& places, const std::array<double, 4>& reciprocals) {
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    double term = places[i];
    for (std::size_t j = 0; j < places.size(); ++j)
      if (j != i) term *= reciprocals[j] / (reciprocals[j] - reciprocals[i]);
    sum += term;
  }
  return sum;
}

/// The data of a contact node for a message.
struct PlaceName {
  mesh::Point position;
  int interface;
  bool isClosed;
};

/// The contact node of all ranks with the largest violation of a condition.
struct Place {
  double margin = INFINITY;  ///< force or gap, relative
  int rank = 0;
  std::size_t node = 0;
};

class PathTracer {
 public:
  PathTracer(CondensedProblem& problem, const Solution& from, const sweep::Parameters& to)
      : problem_(problem),
        line_{from.at, to},
        states_(problem, line_),
        closed_(from.closed),
        sticking_(from.sticking) {
    rank_ = mpi::rank(comm());
    for (const auto& state : from.contact) forceUnit_ = std::max(forceUnit_, state.normalForce);
    forceUnit_ = mpi::max(comm(), forceUnit_);
    if (forceUnit_ == 0) forceUnit_ = 1;  // no contact forces
  }

  ContactPath trace() {
    ContactPath path;
    path.end = at(1);
    double s = 0;
    int inPlace = 0;  // successive events at one place
    while (true) {
      const double reach = states_.reach(s, closed_, sticking_);
      Place worst = worstAt(reach);
      if (worst.margin >= -rounding) {
        if (!state_.found) {
          path.obstacle = "no equilibrium is found there";
          path.end = at(reach);
          break;
        }
        if (reach >= 1) break;
        s = reach;
        continue;
      }
      double event = reach;
      // The first of the nodes that violate a condition ahead.
      Place first = worst;
      std::optional<double> pole;
      while (worst.margin < -rounding && event > s) {
        first = worst;
        const SignChange found = signChange(first, s, event);
        event = found.at, pole = found.pole;
        worst = worstAt(event, &first);
      }
      if (pole) {
        path.obstacle =
            "the equations of its active set are singular there: forces and gaps become infinite";
        path.end = at(*pole);
        break;
      }
      inPlace = event > s ? 0 : inPlace + 1;
      const auto next = inPlace > mostTogether ? std::nullopt : change(first, event, path);
      if (!next) {
        path.obstacle = turningPoint(first);
        path.end = at(event);
        break;
      }
      s = *next;
    }
    if (path.obstacle.empty()) {
      path.gaps = gaps();
      path.closed = closed_;
      // Held again, an unheld node may lead to another solution than that of the path.
      for (std::size_t i = 0; i < closed_.size(); ++i)
        sticking_.heldAgain[i] = closed_[i] && sticking_.holds[i] == steady::Hold::open;
      path.sticking = sticking_;
    }
    return path;
  }

 private:
  MPI_Comm comm() const { return problem_.comm(); }
  sweep::Parameters at(double s) const { return line_.at(s); }
  bool sticks(std::size_t i) const {
    return problem_.contact().interfaces.nodes[i].role == contact::Role::sticking;
  }
  contact::ActiveSet set() const { return {closed_, sticking_.free()}; }
  /// Returns the gaps of the last state computed, [contact node].
  std::vector<double> gaps() const {
    std::vector<double> found;
    for (std::size_t i = 0; i < closed_.size(); ++i)
      found.push_back(closed_[i] ? 0 : std::max(0.0, state_.causes[closed_.size() + i]));
    return found;
  }
  /// Returns the forces at closed nodes and the gaps at open ones, relative, [contact node];
  /// infinity at nodes that do not separate.
  const std::vector<double>& margins(double s) {
    state_ = states_.at(s, closed_, sticking_);
    margins_.clear();
    const std::size_t n = closed_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double force =
          closed_[i] ? state_.effects[n + i] : problem_.gapStiffness(i) * state_.causes[n + i];
      margins_.push_back(problem_.contact().interfaces.nodes[i].separates ? force / forceUnit_
                                                                          : INFINITY);
    }
    return margins_;
  }
  /// Returns the worst place, except `but`.
  Place worstAt(double s, const Place* but = nullptr) {
    const auto& values = margins(s);
    Place worst{INFINITY, rank_, 0};
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] < worst.margin && !(but && but->rank == rank_ && but->node == i))
        worst.margin = values[i], worst.node = i;
    const auto least = mpi::minLocated(comm(), worst.margin);
    mpi::broadcast(comm(), worst.node, least.rank);
    return {least.value, least.rank, worst.node};
  }
  double marginOf(const Place& place, double s) {
    const auto& values = margins(s);
    double value = rank_ == place.rank ? values[place.node] : 0;
    mpi::broadcast(comm(), value, place.rank);
    return value;
  }
  /// Collective. Returns the message that a solution cannot be continued where this node changes.
  std::string turningPoint(const Place& place) const {
    PlaceName name{};
    if (rank_ == place.rank) {
      const auto& node = problem_.contact().interfaces.nodes[place.node];
      name = {node.position, node.interface, closed_[place.node] != 0};
    }
    mpi::broadcast(comm(), name, place.rank);
    return formatted(
        "the contact node at %s of interface '%s' %s there, and no active set is consistent after "
        "it",
        interfaces::text(name.position).c_str(),
        problem_.contact().interfaces.names[name.interface].c_str(),
        name.isClosed ? "opens" : "closes");
  }
  /// Returns the point between `low` and `high` where the force or the gap of a node changes its
  /// sign; it is negative at `high`.
  SignChange signChange(const Place& place, double low, double high) {
    const double atHigh = marginOf(place, high);
    double from = low, atLow = marginOf(place, low);
    if (!(atLow > 0)) {  // round-off: the node has just changed here
      from = std::min(low + behind, high);
      atLow = marginOf(place, from);
    }
    if (!(atLow > 0) || !(from < high)) return {low, {}};
    if (!(atHigh < 0)) return {high, {}};
    std::uintmax_t steps = 100;
    const auto [a, b] = boost::math::tools::toms748_solve(
        [&](double s) { return marginOf(place, s); }, from, high, atLow, atHigh,
        [](double x, double y) { return std::abs(x - y) <= 1e-11; }, steps);
    const double found = (a + b) / 2, near = 1e-3 * std::min(found - from, high - found);
    // A function becomes small towards a zero and large towards a pole. At the pole the equations
    // are singular and round-off dominates, so test at some distance.
    if (!(marginOf(place, found - near) > std::max(atLow, -atHigh))) return {found, {}};
    const std::array places{found - 2 * near, found - near, found + near, found + 2 * near};
    std::array<double, 4> reciprocals;
    for (std::size_t i = 0; i < places.size(); ++i) reciprocals[i] = 1 / marginOf(place, places[i]);
    return {found - near, poleNear(places, reciprocals)};
  }
  /// Opens or closes a node of this rank. One of a sticking interface is held again when it closes,
  /// at most once at each event, as in steady::revised().
  void change(std::size_t i) {
    closed_[i] = !closed_[i];
    if (!sticks(i)) return;
    const bool isHeld = closed_[i] && !sticking_.heldAgain[i];
    sticking_.holds[i] = isHeld ? steady::Hold::held : steady::Hold::open;
    if (isHeld) sticking_.heldAgain[i] = 1;
  }
  /// Changes a node and the nodes that change with it. Returns the place from which the path goes
  /// on; none if no active set is consistent after the event.
  std::optional<double> change(Place place, double s, ContactPath& path) {
    const contact::ActiveSet before = set();
    const Sticking heldBefore = sticking_;
    const double next = std::min(1.0, s + behind);
    for (auto* mask : {&sticking_.heldAgain, &sticking_.slidBack}) mask->assign(closed_.size(), 0);
    for (int together = 0; together < mostTogether; ++together) {
      if (rank_ == place.rank) change(place.node);
      place = worstAt(next);
      if (place.margin < -rounding || !state_.found) continue;
      if (record(before, s, path)) return s;
      break;  // all changes are undone: the path turns back
    }
    closed_ = before.closed, sticking_ = heldBefore;
    return jump(before, s, path);
  }
  /// Changes to the active set that SNES finds from the present state shortly after s. Returns the
  /// place where it is found, if it is.
  std::optional<double> jump(const contact::ActiveSet& before, double s, ContactPath& path) {
    const Sticking heldBefore = sticking_;
    for (const double ahead : {behind, 1e-5, 1e-3}) {
      double next = std::min(1.0, s + ahead);
      margins(s);
      problem_.startFrom(gaps(), sticking_);
      Solution found = problem_.solve(at(next));
      if (!found.converged) continue;
      if (ahead > behind) {  // perhaps the state found also exists nearer to the event
        const double nearer = std::min(1.0, s + behind);
        std::vector<double> gaps;
        for (const auto& state : found.contact) gaps.push_back(state.coefficient);
        problem_.startFrom(std::move(gaps), found.sticking);
        if (Solution there = problem_.solve(at(nearer));
            there.converged && !contact::sameOnAllRanks(comm(), steady::activeSet(there), before))
          found = std::move(there), next = nearer;
      }
      closed_ = found.closed, sticking_ = found.sticking;
      if (record(before, s, path)) return next;
      closed_ = before.closed, sticking_ = heldBefore;
    }
    return {};
  }
  bool record(const contact::ActiveSet& before, double s, ContactPath& path) {
    const auto changes = changesBetween(before, set(), at(s), path.count);
    path.events.insert(path.events.end(), changes.begin(), changes.end());
    const int all = mpi::sum(comm(), static_cast<int>(changes.size()));
    path.count += all;
    return all > 0;
  }

  CondensedProblem& problem_;
  const Line line_;
  PathStates states_;
  contact::Mask closed_;
  Sticking sticking_;
  impedance::ContactSolution state_;  // the last one computed
  std::vector<double> margins_;
  double forceUnit_ = 0;
  int rank_ = 0;
};

}  // namespace

std::string text(Change change) {
  switch (change) {
    case Change::opens:
      return "opens";
    case Change::closes:
      return "closes";
    case Change::unheld:
      return "unheld";
    case Change::held:
      return "held";
  }
  return "";
}

std::vector<ContactEvent> changesBetween(const contact::ActiveSet& before,
                                         const contact::ActiveSet& after,
                                         const sweep::Parameters& at, int order) {
  std::vector<ContactEvent> found;
  for (std::size_t i = 0; i < before.closed.size(); ++i) {
    const bool isReleased = after.released[i] != 0;
    if (before.closed[i] != after.closed[i])
      found.push_back({at, i, after.closed[i] ? Change::closes : Change::opens, isReleased, order});
    else if (after.closed[i] && before.released[i] != after.released[i])
      found.push_back({at, i, isReleased ? Change::unheld : Change::held, isReleased, order});
  }
  return found;
}

ContactPath traceContact(CondensedProblem& problem, const Solution& from,
                         const sweep::Parameters& to) {
  auto [gaps, sticking] = problem.start();
  ContactPath path = PathTracer(problem, from, to).trace();
  problem.startFrom(std::move(gaps), std::move(sticking));
  return path;
}

}  // namespace squeal::condensed
