#include "eigen/tracking/track.hpp"

#include <algorithm>
#include <cmath>
#include <list>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "eigen/tracking/join.hpp"
#include "eigen/tracking/screen.hpp"

namespace squeal::tracking {
namespace {

/// Two joined eigenvalues: their indices at both ends of the step, and |tr(Π Π')|.
struct Link {
  std::size_t here, there;
  double overlap;
};

/// The result of one step, kept only if the step is not halved. Its branches are indices of pairs
/// at the lower end until all earlier steps are finished.
struct StepResult {
  std::vector<Link> links;
  std::vector<Event> events;
  std::vector<Gap> gaps;
  std::vector<ContinuedPair> singles;  // to be screened
  bool sure = true;
};

/// A station with its problem.
struct Solved {
  Station station;
  linalg::DenseProblem problem;
  linalg::Spectrum spectrum;
  std::optional<StepResult> step = {};  // from the station before
  bool whole = false;                   // the step from the station before is not to be halved
  double smallest = 0;                  // smallest step here
};

/// Two eigenvalues at one friction.
struct PairAt {
  double friction;
  linalg::Spectrum spectrum;
  const std::vector<linalg::DensePair>& pairs() const { return spectrum.pairs(); }
};

int sign(Complex s, bool damped) { return neutral(s, damped) ? 0 : s.real() > 0 ? 1 : -1; }

/// Returns the sign of the growth of pair k. Where all are equal, it is that of their mean:
/// rounding parts them like a square root.
int growthOf(const std::vector<linalg::DensePair>& pairs, std::size_t k, bool damped) {
  return sign(coincide(pairs) ? mean(pairs) : pairs[k].s, damped);
}

/// Returns true if one of both signs of the growth is that of an unstable eigenvalue.
bool changes(int before, int after) { return before != after && std::max(before, after) == 1; }

/// Returns true if equal eigenvalues s may part there into a growing and a decaying one: they are
/// neutral or, in a problem in s², real.
bool meetingPoint(Complex s, bool damped) { return neutral(s, damped) || (!damped && real(s)); }

int unstable(const std::vector<linalg::DensePair>& pairs, bool damped) {
  return std::ranges::count_if(pairs, [&](const auto& p) { return sign(p.s, damped) > 0; });
}

class Follower {
 public:
  Follower(const std::vector<Piece>& path, const pencil::WatchedBand& band,
           const TrackLimits& limits)
      : path_(path), limits_(limits) {
    result_.band = band;
  }

  Branches run() {
    std::list<Solved> row;  // the last station already finished, and the next ones
    for (; piece_ < path_.size(); ++piece_) run(path_[piece_].frictions, row);
    return std::move(result_);
  }

 private:
  static constexpr std::size_t mostTogether = 4;  // stations whose matrices are held at a time

  Family& family() const { return *path_[piece_].family; }

  void run(const std::vector<double>& frictions, std::list<Solved>& row) {
    int ranks = 1;
    check(MPI_Comm_size(family().comm(), &ranks));
    const std::size_t together = std::min<std::size_t>(ranks, mostTogether);
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
          found[k]->step = jump(row.back(), *found[k]);
          found[k]->whole = true;
        }
        row.push_back(std::move(*found[k]));
      }
      refine(row);
      const Solved* last = nullptr;
      for (auto& next : row) {
        if (last || result_.stations.empty()) finish(last, next);
        last = &next;
      }
      if (!row.empty())
        family().progress(formatted("%d branches followed to friction %g", result_.count,
                                    row.back().station.friction));
      if (!row.empty()) row.erase(row.begin(), std::prev(row.end()));
    }
  }

  /// Solves the problems at these frictions together, [friction]; none where there is no problem.
  std::vector<std::optional<Solved>> solve(const std::vector<double>& frictions, bool swept) {
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
    std::vector<std::optional<Solved>> list(frictions.size());
    for (std::size_t i = 0; i < problems.size(); ++i) {
      Station station{frictions[places[i]], swept, std::move(pairs[i]), {}, {}, {}, piece_};
      station.branch.assign(station.pairs.size(), -1);
      station.overlap.assign(station.pairs.size(), 0);
      for (const auto& pair : station.pairs)
        station.inBand.push_back(result_.band.contains(pair.s));
      linalg::Spectrum spectrum(problems[i], station.pairs);
      list[places[i]].emplace(
          Solved{std::move(station), std::move(problems[i]), std::move(spectrum)});
    }
    return list;
  }

  /// Adds frictions in between until all continuations are certain or the steps are too small. The
  /// problems of a round are solved together.
  void refine(std::list<Solved>& row) {
    for (bool open = true; open;) {
      std::vector<std::list<Solved>::iterator> places;
      std::vector<double> middles;
      for (auto a = row.begin(), b = row.begin(); a != row.end() && ++b != row.end(); a = b) {
        if (!b->step) b->step = join(*a, *b);
        if (b->step->sure || b->whole || b->station.friction - a->station.friction <= b->smallest)
          continue;
        places.push_back(b);
        middles.push_back(0.5 * (a->station.friction + b->station.friction));
      }
      auto found = solve(middles, false);
      for (std::size_t k = 0; k < places.size(); ++k) {
        Solved& end = *places[k];
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
  void finish(const Solved* a, Solved& b) {
    if (a) {
      StepResult& step = *b.step;
      for (const auto& link : step.links) {
        b.station.branch[link.there] = a->station.branch[link.here];
        b.station.overlap[link.there] = link.overlap;
        result_.entered += !a->station.inBand[link.here] && b.station.inBand[link.there];
        result_.left += a->station.inBand[link.here] && !b.station.inBand[link.there];
      }
      // At a jump the problems at both ends have other unknowns, and nothing lies in between.
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

  bool matters(const Solved& a, const Solved& b, const Group& group) const {
    return std::any_of(group.here.begin(), group.here.end(),
                       [&](auto i) { return a.station.inBand[i]; }) ||
           std::any_of(group.there.begin(), group.there.end(),
                       [&](auto j) { return b.station.inBand[j]; });
  }

  /// Returns true if a member has a damping ratio within that of the band. Strongly damped
  /// eigenvalues need not be told apart.
  bool lasts(const Solved& a, const Solved& b, const Group& group) const {
    const auto one = [&](const Solved& end, std::size_t i) {
      return result_.band.lasts(end.station.pairs[i].s);
    };
    return std::any_of(group.here.begin(), group.here.end(), [&](auto i) { return one(a, i); }) ||
           std::any_of(group.there.begin(), group.there.end(), [&](auto j) { return one(b, j); });
  }

  /// Joins the last station of one piece and the first of the next.
  StepResult jump(const Solved& a, const Solved& b) {
    StepResult step;
    const auto here = path_[a.station.piece].family->shared(a.station.friction, a.station.pairs),
               there = family().shared(b.station.friction, b.station.pairs);
    const bool damped = there.damped();
    for (const auto& group : groups(here, there)) {
      if (!group.joined()) {
        unsure(step, a, b, group, matters(a, b, group), here, there);
        continue;
      }
      const auto from = chosen(here.pairs(), group.here), to = chosen(there.pairs(), group.there);
      const bool single = from.size() == 1;
      const auto mate = single ? std::vector<std::size_t>{0} : ordered(from, to);
      for (std::size_t k = 0; k < mate.size(); ++k) {
        const std::size_t i = group.here[k], j = group.there[mate[k]];
        step.links.push_back({i, j, single ? std::abs(here.overlap(i, there, j)) : 1});
        const int before = growthOf(from, k, damped), after = growthOf(to, mate[k], damped);
        if (changes(before, after) && matters(a, b, group))
          step.events.push_back({Event::Kind::contact,
                                 int(i),
                                 -1,
                                 after > before,
                                 a.station.friction,
                                 b.station.friction,
                                 {a.station.pairs[i]},
                                 {b.station.pairs[j]},
                                 0});
      }
    }
    return step;
  }

  StepResult join(const Solved& a, const Solved& b) {
    StepResult step;
    for (const auto& group : groups(a.spectrum, b.spectrum)) {
      const bool known = group.joined() && group.here.size() == 1;
      if (known) {
        single(step, a, b, group);
      } else if (!group.joined() || !lasts(a, b, group) || !several(step, a, b, group)) {
        const bool counts = matters(a, b, group);
        unsure(step, a, b, group, counts, a.spectrum, b.spectrum);
        step.sure = step.sure && !counts;
      }
    }
    return step;
  }

  void single(StepResult& step, const Solved& a, const Solved& b, const Group& group) {
    const std::size_t i = group.here[0], j = group.there[0];
    const int branch = i;  // until all earlier steps are finished
    step.links.push_back({i, j, std::abs(a.spectrum.overlap(i, b.spectrum, j))});
    if (!matters(a, b, group)) return;
    const linalg::DensePair &p = a.spectrum.pairs()[i], &q = b.spectrum.pairs()[j];
    step.singles.push_back({branch, p, q, isolation(a, b, group)});
    const bool damped = a.spectrum.damped();
    crossed(step, a.station.friction, b.station.friction, {p}, {q}, sign(p.s, damped),
            sign(q.s, damped), branch, step.singles.back().isolation);
  }

  /// Appends an event if an eigenvalue changes its stability by itself: the pair of `below`, or the
  /// two there, where they are equal. `before` and `after` are the signs of the growth.
  static void crossed(StepResult& step, double low, double high,
                      const std::vector<linalg::DensePair>& below,
                      const std::vector<linalg::DensePair>& above, int before, int after,
                      int branch, double isolation) {
    if (!changes(before, after)) return;  // between neutral and decaying: stable on both sides
    Event event{
        Event::Kind::crossing, branch, -1, after > before, low, high, below, above, isolation};
    if (real(below[0].s) || real(above[0].s)) {
      event.kind = Event::Kind::divergence;
    } else if (before * after == 0) {
      (before == 0 ? event.high : event.low) = before == 0 ? event.low : event.high;
    }
    step.events.push_back(std::move(event));
  }

  /// Joins several eigenvalues as a group. Returns false if more frictions in between are needed to
  /// tell them apart.
  bool several(StepResult& step, const Solved& a, const Solved& b, const Group& group) {
    const auto here = chosen(a.spectrum.pairs(), group.here),
               there = chosen(b.spectrum.pairs(), group.there);
    std::vector<std::size_t> mate;
    const std::vector<int> ids(group.here.begin(), group.here.end());
    StepResult traced;
    if (here.size() == 2) {
      const PairAt low{a.station.friction, linalg::Spectrum(a.problem, here)},
          high{b.station.friction, linalg::Spectrum(b.problem, there)};
      const double smallest = std::ldexp(high.friction - low.friction, -14);
      if (!trace(low, high, ids, isolation(a, b, group), smallest, mate, traced)) return false;
    } else if (mate = ordered(here, there); !(coincide(here) || coincide(there)) ||
                                            !atEnd(traced, a, b, here, there, ids, mate)) {
      return false;
    }
    step.events.insert(step.events.end(), traced.events.begin(), traced.events.end());
    step.gaps.insert(step.gaps.end(), traced.gaps.begin(), traced.gaps.end());
    for (std::size_t k = 0; k < mate.size(); ++k)
      step.links.push_back({group.here[k], group.there[mate[k]], 1});
    return true;
  }

  /// An event where equal eigenvalues part at once.
  static Event parting(int branch, bool loss, double friction, const linalg::DensePair& below,
                       const linalg::DensePair& above) {
    return {Event::Kind::coalescence, branch, -1, loss, friction, friction, {below}, {above}, 0};
  }

  /// Appends events where three or more eigenvalues are equal at one end and change their stability
  /// right there. Returns false if they change it elsewhere.
  bool atEnd(StepResult& step, const Solved& a, const Solved& b,
             const std::vector<linalg::DensePair>& here,
             const std::vector<linalg::DensePair>& there, const std::vector<int>& ids,
             const std::vector<std::size_t>& mate) {
    const bool damped = b.spectrum.damped(), equalBelow = coincide(here);
    const Solved& apart = equalBelow ? b : a;
    const Complex s = mean(equalBelow ? here : there);
    const double equalAt = (equalBelow ? a : b).station.friction,
                 near = equalAt + closer * (apart.station.friction - equalAt);
    for (std::size_t k = 0; k < here.size(); ++k) {
      const int before = growthOf(here, k, damped), after = growthOf(there, mate[k], damped);
      if (!changes(before, after)) continue;
      const auto& pair = equalBelow ? there[mate[k]] : here[k];
      const Complex way = closer * (pair.s - s);
      const auto found = continuedTo(family(), near, linalg::Spectrum(apart.problem, {pair}),
                                     s + way, std::abs(way));
      if (!meetingPoint(s, damped) || !found || found->pairs()[0].s.real() / way.real() < 0.1)
        return false;
      step.events.push_back(parting(ids[k], after > before, equalAt, here[k], there[mate[k]]));
    }
    return true;
  }

  /// Follows two eigenvalues from one friction to another in their common subspace. `mate` becomes
  /// the place at `high` of each at `low`. Returns false if the subspace is lost.
  bool trace(const PairAt& low, const PairAt& high, const std::vector<int>& ids, double isolation,
             double smallest, std::vector<std::size_t>& mate, StepResult& step) {
    const auto& a = low.pairs();
    const auto& b = high.pairs();
    if (coincide(a) || coincide(b))
      return traceFromEqual(low, high, ids, isolation, smallest, mate, step);
    const bool damped = low.spectrum.damped();
    const bool merging = neutralPair(a, damped) && splitPair(b, damped),
               parting = splitPair(a, damped) && neutralPair(b, damped);
    if (merging || parting) {
      mate = ordered(a, b);
      const auto& split = merging ? b : a;
      const auto& whole = merging ? a : b;
      const std::size_t grown = split[0].s.real() > 0 ? 0 : 1,
                        grownLow = merging ? (mate[0] == grown ? 0 : 1) : grown;
      // Where two neutral eigenvalues merge, the growing one loses its stability. Where two real
      // ones merge, the decaying one regains it.
      const bool divergent = real(whole[0].s);
      const std::size_t own = divergent ? 1 - grownLow : grownLow;
      step.events.push_back({Event::Kind::coalescence, ids[own], ids[1 - own], merging != divergent,
                             low.friction, high.friction, a, b, isolation});
      return true;
    }
    const Group both{{0, 1}, {0, 1}, 0};
    mate = assigned(low.spectrum, high.spectrum, both);
    bool clear = true;
    for (std::size_t i = 0; i < 2; ++i) {
      clear = clear && std::abs(low.spectrum.overlap(i, high.spectrum, mate[i]) - 1.0) < 0.25;
      clear = clear && std::abs(low.spectrum.overlap(i, high.spectrum, mate[1 - i])) < 0.25;
    }
    // A change of stability is sought on still smaller steps.
    const bool changed = unstable(a, damped) != unstable(b, damped);
    if (clear || high.friction - low.friction < (changed ? least * smallest : smallest)) {
      for (std::size_t i = 0; i < 2 && (clear || changed);
           ++i)  // whichever is which, as many change
        crossed(step, low.friction, high.friction, {a[i]}, {b[mate[i]]}, sign(a[i].s, damped),
                sign(b[mate[i]].s, damped), ids[i],
                std::min(isolation, 2 * std::abs(a[0].s - mean(a))));
      if (!clear)
        step.gaps.push_back(
            {low.friction, high.friction,
             formatted("two eigenvalues near %.6g Hz too close to tell apart: both are there, "
                       "which is which is not certain",
                       mean(a).imag() / (2 * M_PI)),
             true});
      return true;
    }
    const double middle = 0.5 * (low.friction + high.friction);
    const auto found =
        continuedTo(family(), middle, low.spectrum, 0.5 * (mean(a) + mean(b)), isolation);
    if (!found) return false;
    return traceBy({middle, *found}, low, high, ids, isolation, smallest, mate, step);
  }

  /// Follows two eigenvalues from `low` to `high` by a friction in between.
  bool traceBy(const PairAt& between, const PairAt& low, const PairAt& high,
               const std::vector<int>& ids, double isolation, double smallest,
               std::vector<std::size_t>& mate, StepResult& step) {
    std::vector<std::size_t> first, second;
    if (!trace(low, between, ids, isolation, smallest, first, step)) return false;
    std::vector<int> idsBetween(2);
    for (std::size_t i = 0; i < 2; ++i) idsBetween[first[i]] = ids[i];
    if (!trace(between, high, idsBetween, isolation, smallest, second, step)) return false;
    mate = {second[first[0]], second[first[1]]};
    return true;
  }

  static constexpr double closer = 1. / 16;    // part of a step, to approach equal eigenvalues
  static constexpr double least = 1. / 65536;  // of `smallest`, to look for a change of stability

  /// Returns the two eigenvalues at a part of the way from where they are equal to `apart`.
  std::optional<PairAt> within(const PairAt& equal, const PairAt& apart, double part,
                               double isolation) {
    const double friction = equal.friction + part * (apart.friction - equal.friction);
    const Complex expected = (1 - part) * mean(equal.pairs()) + part * mean(apart.pairs());
    auto found = continuedTo(family(), friction, apart.spectrum, expected, isolation);
    if (!found) return {};
    return PairAt{friction, std::move(*found)};
  }

  /// Finds whether two eigenvalues part right where they are equal, into those at `apart`. If not,
  /// `between` is where they have not yet done so. Returns false if they are lost on the way.
  bool partAtOnce(const PairAt& equal, const PairAt& apart, double isolation, double smallest,
                  std::optional<PairAt>& between) {
    const bool damped = apart.spectrum.damped();
    PairAt last = apart;
    while (!between && std::abs(last.friction - equal.friction) > smallest) {
      auto found = within(equal, last, closer, isolation);
      if (!found) return false;
      if (coincide(found->pairs())) break;
      // In a problem in s² the growth may be too small here to count as such.
      if (damped ? unstable(found->pairs(), true) != unstable(apart.pairs(), true)
                 : discriminant(found->pairs(), false) > 0)
        between = found;
      last = std::move(*found);
    }
    return true;
  }

  /// Does the same as trace() for two eigenvalues that are equal at an end. If one of them changes
  /// its stability, the step is cut ever closer to that end, for the change may lie anywhere beside
  /// it.
  bool traceFromEqual(const PairAt& low, const PairAt& high, const std::vector<int>& ids,
                      double isolation, double smallest, std::vector<std::size_t>& mate,
                      StepResult& step) {
    const auto& a = low.pairs();
    const auto& b = high.pairs();
    const bool damped = low.spectrum.damped(), equalBelow = coincide(a),
               equalTwice = equalBelow && coincide(b);
    mate = ordered(a, b);
    const auto before = [&](std::size_t k) { return growthOf(a, k, damped); };
    const auto after = [&](std::size_t k) { return growthOf(b, mate[k], damped); };
    if (!changes(before(0), after(0)) && !changes(before(1), after(1))) return true;
    const PairAt &equal = equalBelow ? low : high, &apart = equalBelow ? high : low;
    if (!equalTwice && meetingPoint(mean(equal.pairs()), damped) &&
        (damped || splitPair(apart.pairs(), damped))) {
      std::optional<PairAt> between;
      if (!partAtOnce(equal, apart, isolation, smallest, between)) return false;
      if (between) return traceBy(*between, low, high, ids, isolation, smallest, mate, step);
      for (std::size_t k = 0; k < 2; ++k)
        if (changes(before(k), after(k)))
          step.events.push_back(
              parting(ids[k], after(k) > before(k), equal.friction, a[k], b[mate[k]]));
      return true;
    }
    const bool last = high.friction - low.friction < least * smallest;
    if (!last) {
      const auto found = within(equal, apart, equalTwice ? 0.5 : closer, isolation);
      if (!found) return false;
      if (!equalTwice || !coincide(found->pairs()))
        return traceBy(*found, low, high, ids, isolation, smallest, mate, step);
    }
    const bool together = equalTwice && !last;
    for (std::size_t k = 0; k < 2; ++k)
      crossed(step, low.friction, high.friction, together ? a : chosen(a, {k}),
              together ? b : chosen(b, {mate[k]}), before(k), after(k), ids[k],
              together ? isolation : std::abs(apart.pairs()[0].s - apart.pairs()[1].s));
    return true;
  }

  /// Joins a group by its largest overlaps, without certainty, and appends a gap if it `counts`.
  void unsure(StepResult& step, const Solved& a, const Solved& b, const Group& group, bool counts,
              const linalg::Spectrum& here, const linalg::Spectrum& there) {
    const auto mate = assigned(here, there, group);
    for (std::size_t k = 0; k < mate.size(); ++k)
      if (mate[k] < group.there.size())
        step.links.push_back({group.here[k], group.there[mate[k]],
                              std::abs(here.overlap(group.here[k], there, group.there[mate[k]]))});
    if (!counts) return;
    const auto pairs = group.here.empty() ? chosen(b.spectrum.pairs(), group.there)
                                          : chosen(a.spectrum.pairs(), group.here);
    step.gaps.push_back(
        {a.station.friction, b.station.friction,
         formatted("%zu eigenvalues near %.6g Hz before and %zu after are joined without certainty",
                   group.here.size(), mean(pairs).imag() / (2 * M_PI), group.there.size())});
  }

  /// Returns the smallest distance of the mean of a group, at either end, from all other
  /// eigenvalues and from zero.
  double isolation(const Solved& a, const Solved& b, const Group& group) const {
    double distance = INFINITY;
    const auto reach = [&](const std::vector<linalg::DensePair>& pairs,
                           const std::vector<std::size_t>& own) {
      const Complex middle = mean(chosen(pairs, own));
      distance = std::min(distance, std::abs(middle));
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (std::find(own.begin(), own.end(), i) == own.end())
          distance = std::min(distance, std::abs(pairs[i].s - middle));
    };
    reach(a.spectrum.pairs(), group.here);
    reach(b.spectrum.pairs(), group.there);
    return distance;
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

Branches follow(const std::vector<Piece>& path, const pencil::WatchedBand& band,
                const TrackLimits& limits) {
  return Follower(path, band, limits).run();
}

Branches follow(Family& family, const std::vector<double>& frictions,
                const pencil::WatchedBand& band, const TrackLimits& limits) {
  return follow({{&family, frictions}}, band, limits);
}

}  // namespace squeal::tracking
