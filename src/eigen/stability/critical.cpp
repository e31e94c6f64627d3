#include "eigen/stability/critical.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <type_traits>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/rayleigh_ritz.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/tracking/join.hpp"

namespace squeal::stability {

using tracking::continuedIn;
using tracking::discriminant;
using tracking::mean;
using tracking::PairsAtFriction;
using tracking::real;

namespace {

/// Finds the root of a continuous function in a bracket by the method of T. R. Chandrupatla
/// (Advances in Engineering Software 28 (1997) 145–149): inverse quadratic interpolation where it
/// is safe, otherwise bisection. The caller evaluates the function at next() and passes the value
/// to take().
class BracketedRoot {
 public:
  BracketedRoot(double a, double fa, double b, double fb, double tolerance)
      : a_(a), fa_(fa), b_(b), fb_(fb), c_(a), fc_(fa), t_(fa / (fa - fb)), tolerance_(tolerance) {}
  double next() const { return a_ + t_ * (b_ - a_); }
  void take(double fx) {
    const double x = next();
    if ((fx > 0) == (fa_ > 0)) {
      c_ = a_, fc_ = fa_;
    } else {
      c_ = b_, fc_ = fb_;
      b_ = a_, fb_ = fa_;
    }
    a_ = x, fa_ = fx;
    const double limit = tolerance_ / std::abs(b_ - a_);
    done_ = fa_ == 0 || limit > 0.5 || ++count_ == 100;
    if (done_) return;
    const double xi = (a_ - b_) / (c_ - b_), phi = (fa_ - fb_) / (fc_ - fb_);
    t_ = 0.5;
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
      t_ = fa_ / (fb_ - fa_) * fc_ / (fb_ - fc_) +
           (c_ - a_) / (b_ - a_) * fa_ / (fc_ - fa_) * fb_ / (fc_ - fb_);
    t_ = std::clamp(t_, limit, 1 - limit);
  }
  bool done() const { return done_; }
  double root() const { return std::abs(fa_) < std::abs(fb_) ? a_ : b_; }

 private:
  double a_, fa_, b_, fb_, c_, fc_, t_, tolerance_;
  int count_ = 0;
  bool done_ = false;
};

/// The search for the critical friction of one event, on one rank.
class Root {
 public:
  Root(const Event& event, double tolerance)
      : event_(event),
        tolerance_(tolerance),
        throughZero_(real(event.below[0].s) && real(event.above[0].s)) {}

  /// Locates the critical friction in the present basis; `changed` says whether that differs from
  /// the basis of the last call.
  void locate(Family& family, bool changed) {
    const double before = friction_;
    // At an end of a step equal eigenvalues part, and between two pieces of a path they jump.
    if (event_.low == event_.high || event_.kind == Event::Kind::contact) {
      friction_ = 0.5 * (event_.low + event_.high);
      settled_ = true;
      return;
    }
    const bool first = known_.empty();
    friction_ = first ? searchFromEnds(family) : refined(family);
    moved_ = first ? roughly() : changed ? std::abs(friction_ - before) : 0;
    settled_ = std::isnan(friction_) || (!first && moved_ <= tolerance_ * friction_);
  }
  bool settled() const { return settled_; }

  /// Returns the friction with one pair, which has the mean of the eigenvalues: where two
  /// eigenvalues meet, so do their vectors.
  PairsAtFriction located() const {
    std::vector<linalg::DensePair> pairs = nearest(friction_).pairs();
    const Complex s = mean(pairs);
    pairs.resize(1);
    pairs[0].s = s;
    return {friction_, pairs};
  }
  /// Keeps the backward error, NaN if there is no problem at the located friction, and the bound on
  /// the round-off in yᴴP(s)x of unit vectors.
  void setErrors(double backwardError, double roundOff) {
    lost_ = std::isnan(backwardError);
    if (!lost_) backwardError_ = backwardError, roundOff_ = roundOff;
  }

  Critical result() const {
    Critical result{event_.kind,    event_.branch, event_.partner, friction_, 0, 0, event_.loss, 0,
                    backwardError_, true};
    result.piece = event_.piece;
    if (event_.low == event_.high || event_.kind == Event::Kind::contact) {
      result.angularFrequency = mean(event_.below).imag();
      result.errorEstimate = 0.5 * (event_.high - event_.low);
      result.converged = event_.low == event_.high;
    } else if (std::isnan(friction_)) {
      result.converged = false;
      result.friction = 0.5 * (event_.low + event_.high);
      result.errorEstimate = 0.5 * (event_.high - event_.low);
      result.angularFrequency = 0.5 * (mean(event_.below) + mean(event_.above)).imag();
    } else {
      result.converged = moved_ <= tolerance_ * friction_ &&
                         rootTolerance() <= std::max(tolerance_ * friction_, 1e-12);
      result.errorEstimate = moved_ + rootTolerance() + roundOffError();
      result.angularFrequency = mean(nearest(friction_).pairs()).imag();
      result.slope = event_.kind == Event::Kind::coalescence ? -slope_ : slope_;
    }
    return result;
  }

 private:
  struct Sample {
    double friction, value;
    linalg::Spectrum spectrum;
    const std::vector<linalg::DensePair>& pairs() const { return spectrum.pairs(); }
  };

  double measure(const linalg::Spectrum& spectrum) const {
    const auto& pairs = spectrum.pairs();
    switch (event_.kind) {
      case Event::Kind::coalescence:
        return discriminant(pairs, spectrum.damped());
      case Event::Kind::divergence:
        return throughZero_ && spectrum.damped() ? mean(pairs).real()
                                                 : (mean(pairs) * mean(pairs)).real();
      case Event::Kind::crossing:
        return mean(pairs).real();  // of two equal ones, where they cross together
      case Event::Kind::contact:
        break;  // it jumps
    }
    return NAN;
  }

  const Sample& nearest(double friction) const {
    return *std::min_element(known_.begin(), known_.end(), [&](const Sample& a, const Sample& b) {
      return std::abs(a.friction - friction) < std::abs(b.friction - friction);
    });
  }

  /// Returns the mean of the eigenvalues, interpolated between the nearest known frictions on both
  /// sides.
  Complex expected(double friction) const {
    const Sample *below = &known_[0], *above = &known_[1];
    for (const auto& sample : known_) {
      if (sample.friction <= friction && sample.friction > below->friction) below = &sample;
      if (sample.friction >= friction && sample.friction < above->friction) above = &sample;
    }
    const double width = above->friction - below->friction,
                 t = width > 0 ? (friction - below->friction) / width : 0;
    return (1 - t) * mean(below->pairs()) + t * mean(above->pairs());
  }

  /// Returns the function at a friction and keeps a sample. The value is NaN if there is no problem
  /// at this friction, or if the eigenvalues are not found in it. It is zero, without a sample,
  /// where two eigenvalues have met so closely that they cannot be told apart.
  double valueAt(Family& family, double friction) {
    if (reach(family, friction)) return known_.back().value;
    const bool met = event_.kind == Event::Kind::coalescence &&
                     std::abs(friction - nearest(friction).friction) <= 1e-9 * width();
    return met && family.near(friction) ? 0 : NAN;
  }

  /// Returns the samples to continue from, the best first. Two eigenvalues that meet are known best
  /// on the side where they have parted into a growing and a decaying one: on the other side a
  /// third one may pass by and exchange its vector with one of them.
  std::vector<const Sample*> starts(double friction) const {
    const Sample *split = nullptr, *closest = &nearest(friction);
    for (const auto& sample : known_)
      if (event_.kind == Event::Kind::coalescence && sample.value < 0 &&
          (!split || std::abs(sample.friction - friction) < std::abs(split->friction - friction)))
        split = &sample;
    if (!split || split == closest) return {closest};
    return {split, closest};
  }

  /// Appends a sample at a friction, which continues a known one. Where the subspace turns too much
  /// on the way, it goes there in smaller steps. Returns false if that fails, and if there is no
  /// problem on the way.
  bool reach(Family& family, double friction) {
    constexpr int most = 24;  // attempts
    double next = friction;
    for (int attempt = 0; attempt < most; ++attempt) {
      const auto problem = family.near(next);
      if (!problem) return false;
      std::optional<linalg::Spectrum> found;
      for (const Sample* start : starts(next)) {
        found = continuedIn(*problem, start->spectrum, expected(next), event_.isolation);
        if (found) break;
      }
      if (!found) {
        next = 0.5 * (nearest(next).friction + next);
        continue;
      }
      known_.push_back({next, measure(*found), std::move(*found)});
      if (next == friction) return true;
      next = friction;
    }
    return false;
  }

  double rootTolerance() const {
    return 1e-13 * std::max(std::abs(event_.high), std::abs(event_.low));
  }

  /// Returns how far round-off moves the root: what it does to the function, over its slope.
  /// Towards a coalescence the half distance d of two eigenvalues becomes zero, and the condition
  /// of each grows by 1/d, so that d² changes by a finite 2 d δs.
  double roundOffError() const {
    if (!(std::abs(slope_) > 0)) return 0;
    const Sample& sample = nearest(friction_);
    double change = 0;  // of s
    for (std::size_t i = 0; i < sample.pairs().size(); ++i)
      change = std::max(change, roundOff_ / std::abs(sample.spectrum.derivative(i)));
    double perChange = 1;
    if (event_.kind == Event::Kind::coalescence) perChange = 2 * std::sqrt(std::abs(sample.value));
    if (event_.kind == Event::Kind::divergence && !(throughZero_ && sample.spectrum.damped()))
      perChange = 2 * std::abs(mean(sample.pairs()));
    const double error = perChange * change / std::abs(slope_);
    return std::isfinite(error) ? error : 0;
  }

  double width() const { return event_.high - event_.low; }
  /// Returns the tolerance of a root in a basis that is still to be improved. It is small enough
  /// not to hide how far the root moves with the basis.
  double roughly() const { return 1e-7 * width(); }

  double searchFromEnds(Family& family) {
    for (const bool low : {true, false}) {
      const double friction = low ? event_.low : event_.high;
      const auto problem = family.near(friction);
      if (!problem) return NAN;
      linalg::Spectrum spectrum(*problem, low ? event_.below : event_.above);
      known_.push_back({friction, measure(spectrum), std::move(spectrum)});
    }
    return searched(family, known_[0].value, known_[1].value, roughly());
  }

  /// Searches the whole bracket in the present basis. Returns NaN if the root has left the bracket.
  /// Where the function is not known at an end of the bracket, as where equal eigenvalues part, the
  /// value in the first basis is kept.
  double searchedAnew(Family& family) {
    double low = valueAt(family, event_.low), high = valueAt(family, event_.high);
    if (std::isnan(low)) low = known_[0].value;
    if (std::isnan(high)) high = known_[1].value;
    return searched(family, low, high, rootTolerance());
  }

  /// Returns NaN if the values at both ends of the bracket have the same sign.
  double searched(Family& family, double low, double high, double tolerance) {
    if (low == 0) return event_.low;
    if (high == 0) return event_.high;
    if ((low > 0) == (high > 0)) return NAN;
    BracketedRoot search(event_.low, low, event_.high, high, tolerance);
    while (!search.done()) {
      const double value = valueAt(family, search.next());
      if (std::isnan(value)) return NAN;
      search.take(value);
    }
    return search.root();
  }

  /// Improves the root of the previous basis in the present one, by Newton's method with a fixed
  /// slope, taken from two frictions 2e-5 of the bracket apart.
  double refined(Family& family) {
    if (lost_) return NAN;
    const Sample start = nearest(friction_);
    known_.erase(known_.begin() + 2, known_.end());
    known_.push_back(start);
    const double left = std::max(event_.low, friction_ - 1e-5 * width());
    double at = std::min(event_.high, friction_ + 1e-5 * width()), last = INFINITY;
    if (!(left < at)) return searchedAnew(family);  // the difference would be below rounding
    const double before = valueAt(family, left);
    double value = valueAt(family, at);
    slope_ = (value - before) / (at - left);
    for (int step = 1; std::isfinite(value) && std::isfinite(slope_); ++step) {
      const double change = -value / slope_, next = at + change;
      const bool inside = next >= event_.low && next <= event_.high,
                 closer = step <= 2 || std::abs(change) < 0.1 * last;
      if (!inside || !closer) return searchedAnew(family);
      last = std::abs(change);
      // A step has a relative error of about 1e-4.
      if (step > 1 && last <= 1e3 * rootTolerance()) return next;
      at = next;
      value = valueAt(family, at);
    }
    return NAN;
  }

  const Event& event_;
  double tolerance_;
  bool throughZero_;  // s is real at both ends; in a problem in s², only s² is analytic there
  double friction_ = NAN, moved_ = 0, backwardError_ = 0, roundOff_ = 0, slope_ = 0;
  bool settled_ = false, lost_ = false;
  std::vector<Sample> known_;  // the two ends of the bracket first
};

/// Takes out of a list, ordered by friction, what two coalescences of the same eigenvalues undo: a
/// growth that lies within the errors of both ends is rounding where the two cross.
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

/// The searches for all events, spread over the ranks.
class Roots {
 public:
  Roots(Family& family, const std::vector<Event>& events, double tolerance) : family_(family) {
    check(MPI_Comm_rank(family.comm(), &rank_));
    check(MPI_Comm_size(family.comm(), &ranks_));
    std::vector<double> ends;
    for (const auto& event : events) {
      roots_.emplace_back(event, tolerance);
      if (event.low < event.high && event.kind != Event::Kind::contact)
        ends.insert(ends.end(), {event.low, event.high});
    }
    family.know(ends);
    locate(indices(events.size()), true);
  }

  /// Returns the indices of the events that are not settled.
  std::vector<std::size_t> open() const {
    std::vector<int> is(roots_.size(), 0);
    for (std::size_t i = 0; i < roots_.size(); ++i) is[i] = mine(i) && !roots_[i].settled() ? 1 : 0;
    check(MPI_Allreduce(MPI_IN_PLACE, is.data(), is.size(), MPI_INT, MPI_MAX, family_.comm()));
    auto list = indices(roots_.size());
    std::erase_if(list, [&](auto i) { return is[i] == 0; });
    return list;
  }

  /// Improves the basis for these events and locates them again. Returns false if the basis has not
  /// changed.
  bool improve(const std::vector<std::size_t>& open) {
    std::vector<PairsAtFriction> located;
    for (const auto i : open) {
      PairsAtFriction item = mine(i) ? roots_[i].located() : PairsAtFriction{};
      check(MPI_Bcast(&item.friction, 1, MPI_DOUBLE, owner(i), family_.comm()));
      linalg::shareFrom(owner(i), family_.comm(), item.pairs, linalg::Vectors::both);
      located.push_back(std::move(item));
    }
    const reduction::Improvement improvement = family_.improve(located);
    for (std::size_t k = 0; k < improvement.backwardError.size(); ++k)
      roots_[open[k]].setErrors(improvement.backwardError[k], improvement.roundOff[k]);
    locate(open, improvement.changed);
    return improvement.changed;
  }

  std::vector<Critical> results() const {
    std::vector<Critical> list(roots_.size());
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      if (mine(i)) list[i] = roots_[i].result();
      static_assert(std::is_trivially_copyable_v<Critical>);
      check(MPI_Bcast(&list[i], sizeof(Critical), MPI_BYTE, owner(i), family_.comm()));
    }
    return list;
  }

 private:
  static std::vector<std::size_t> indices(std::size_t count) {
    std::vector<std::size_t> list(count);
    std::iota(list.begin(), list.end(), 0);
    return list;
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
  int rank_ = 0, ranks_ = 1;
  std::vector<Root> roots_;
};

}  // namespace

std::vector<Critical> criticalFrictions(const std::vector<Piece>& path, const Branches& branches,
                                        double tolerance) {
  constexpr int rounds = 10;
  // All are located before the basis grows, beyond that of the vectors of the events.
  std::vector<std::vector<Event>> events(path.size());
  std::vector<std::unique_ptr<Roots>> pieces;
  for (const auto& event : branches.events) events[event.piece].push_back(event);
  for (std::size_t piece = 0; piece < path.size(); ++piece)
    pieces.push_back(std::make_unique<Roots>(*path[piece].family, events[piece], tolerance));
  std::vector<Critical> list;
  for (std::size_t piece = 0; piece < path.size(); ++piece) {
    Roots& roots = *pieces[piece];
    for (int round = 0; round < rounds; ++round) {
      const auto open = roots.open();
      path[piece].family->progress(formatted("%zu of %zu critical frictions to be improved",
                                             open.size(), events[piece].size()));
      if (open.empty() || !roots.improve(open)) break;
    }
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
