#include "steady/contact_path.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "petsc/text.hpp"

namespace squeal::steady {
namespace {

/// A force below minus this part of the largest one pulls, and a gap overlaps likewise; what lies
/// between is rounding.
constexpr double rounding = 1e-9;
/// The length of the line behind an event where the new active set must hold.
constexpr double behind = 1e-7;
/// The largest number of nodes that may change together, beyond which SNES finds the new set.
constexpr int mostTogether = 8;

/// The contact node where a condition is violated most, of all ranks.
struct Place {
  double margin = INFINITY;  ///< force or gap, relative
  int rank = 0;
  std::size_t node = 0;
};

class Follower {
 public:
  Follower(CondensedProblem& problem, const Solution& from, const sweep::Parameters& to)
      : problem_(problem), from_(from.at), to_(to), closed_(from.closed), sticking_(from.sticking) {
    check(MPI_Comm_rank(comm(), &rank_));
    for (const auto& state : from.contact) {
      forceUnit_ = std::max(forceUnit_, state.normalForce);
      gapUnit_ = std::max(gapUnit_, state.coefficient);
    }
    for (double* unit : {&forceUnit_, &gapUnit_})
      check(MPI_Allreduce(MPI_IN_PLACE, unit, 1, MPI_DOUBLE, MPI_MAX, comm()));
  }

  ContactPath follow() {
    ContactPath path;
    path.end = to_;
    double s = 0;
    while (true) {
      Place worst = worstAt(1);
      if (worst.margin >= -rounding) break;
      double event = 1;
      // This is the first one of the nodes that violate a condition ahead.
      Place first;
      while (worst.margin < -rounding && event > s) {
        first = worst;
        event = zero(first, s, event);
        worst = worstAt(event, &first);
      }
      if (!(event > s) && path.count > 0 && last_.rank == first.rank && last_.node == first.node) {
        path.obstacle = "the node that changes there would change back at once";
        path.end = at(s);
        break;
      }
      if (!change(first, event, path)) {
        path.obstacle = "no active set holds behind it";
        path.end = at(event);
        break;
      }
      s = event;
    }
    return path;
  }

 private:
  MPI_Comm comm() const { return problem_.comm(); }
  sweep::Parameters at(double s) const {
    sweep::Parameters point = from_;
    for (const auto value :
         {&sweep::Parameters::friction, &sweep::Parameters::speed, &sweep::Parameters::pressure})
      point.*value = (1 - s) * from_.*value + s * to_.*value;
    return point;
  }
  /// Returns the forces at closed nodes and the gaps at open ones, relative, [contact node].
  const std::vector<double>& margins(double s) {
    const auto state = problem_.onSet(at(s), closed_, sticking_);
    margins_.clear();
    const std::size_t n = closed_.size();
    double widest = gapUnit_;
    for (std::size_t i = 0; i < n; ++i)
      if (!closed_[i]) widest = std::max(widest, std::abs(state.causes[n + i]));
    check(MPI_Allreduce(MPI_IN_PLACE, &widest, 1, MPI_DOUBLE, MPI_MAX, comm()));
    for (std::size_t i = 0; i < n; ++i)
      margins_.push_back(closed_[i]   ? state.effects[n + i] / forceUnit_
                         : widest > 0 ? state.causes[n + i] / widest
                                      : 0);
    return margins_;
  }
  /// Returns the worst place, `but` for one.
  Place worstAt(double s, const Place* but = nullptr) {
    const auto& values = margins(s);
    Place worst{INFINITY, rank_, 0};
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] < worst.margin && !(but && but->rank == rank_ && but->node == i))
        worst.margin = values[i], worst.node = i;
    struct {
      double value;
      int rank;
    } least{worst.margin, rank_};
    check(MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, comm()));
    unsigned long node = worst.node;
    check(MPI_Bcast(&node, 1, MPI_UNSIGNED_LONG, least.rank, comm()));
    return {least.value, least.rank, node};
  }
  double marginOf(const Place& place, double s) {
    const auto& values = margins(s);
    double value = rank_ == place.rank ? values[place.node] : 0;
    check(MPI_Bcast(&value, 1, MPI_DOUBLE, place.rank, comm()));
    return value;
  }
  /// Returns where the force or the gap of a node vanishes, between `low` and `high`, where it is
  /// negative.
  double zero(const Place& place, double low, double high) {
    const double atLow = marginOf(place, low), atHigh = marginOf(place, high);
    if (!(atLow > 0)) return low;
    if (!(atHigh < 0)) return high;
    std::uintmax_t steps = 100;
    const auto [a, b] = boost::math::tools::toms748_solve(
        [&](double s) { return marginOf(place, s); }, low, high, atLow, atHigh,
        [](double x, double y) { return std::abs(x - y) <= 1e-11; }, steps);
    return (a + b) / 2;
  }
  /// Opens or closes a node, and what changes together with it. Returns false if no active set
  /// holds behind the event.
  bool change(Place place, double s, ContactPath& path) {
    const auto before = closed_;
    const double next = std::min(1.0, s + behind);
    last_ = place;
    for (int together = 0; together < mostTogether; ++together) {
      if (rank_ == place.rank) closed_[place.node] = !closed_[place.node];
      place = worstAt(next);
      if (place.margin >= -rounding) return record(before, s, path);
    }
    const Solution found = problem_.solve(at(next));
    if (!found.converged) return false;
    closed_ = found.closed, sticking_ = found.sticking;
    return record(before, s, path);
  }
  bool record(const std::vector<unsigned char>& before, double s, ContactPath& path) {
    int own = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i] != closed_[i]) {
        path.events.push_back({at(s), i, before[i] != 0, path.count});
        ++own;
      }
    check(MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_INT, MPI_SUM, comm()));
    path.count += own;
    return own > 0;
  }

  CondensedProblem& problem_;
  sweep::Parameters from_, to_;
  std::vector<unsigned char> closed_;
  Sticking sticking_;
  std::vector<double> margins_;
  double forceUnit_ = 0, gapUnit_ = 0;
  int rank_ = 0;
  Place last_;
};

}  // namespace

ContactPath followContact(CondensedProblem& problem, const Solution& from,
                          const sweep::Parameters& to) {
  return Follower(problem, from, to).follow();
}

}  // namespace squeal::steady
