#include "flutter/critical.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <type_traits>

#include "flutter/join.hpp"
#include "petsc/check.hpp"
#include "petsc/text.hpp"

namespace squeal::flutter {
namespace {

using Complex = std::complex<double>;

/// Root of a continuous function in a bracket, a value at a time (T. R. Chandrupatla, Advances in Engineering Software 28 (1997)
/// 145–149: inverse quadratic interpolation where it is safe, otherwise halving).
class Search {
 public:
  Search(double a, double fa, double b, double fb, double tolerance)
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
      t_ = fa_ / (fb_ - fa_) * fc_ / (fb_ - fc_) + (c_ - a_) / (b_ - a_) * fa_ / (fc_ - fa_) * fb_ / (fc_ - fb_);
    t_ = std::clamp(t_, limit, 1 - limit);
  }
  bool done() const { return done_; }
  double root() const { return std::abs(fa_) < std::abs(fb_) ? a_ : b_; }

 private:
  double a_, fa_, b_, fb_, c_, fc_, t_, tolerance_;
  int count_ = 0;
  bool done_ = false;
};

/// One event, on one rank. It asks for the problem at one friction after the other.
class Root {
 public:
  Root(const Event& event, double tolerance) : event_(event), tolerance_(tolerance) {}

  /// To be located in the basis in force, which has `changed` since the last time.
  void begin(bool changed) {
    before_ = friction_;
    changed_ = changed;
    steps_ = 0;
    if (event_.low == event_.high) {  // at an end of a step, where equal eigenvalues part
      friction_ = event_.low;
      settled_ = true;
    } else if (known_.empty()) {
      ask(Phase::low, event_.low);
    } else {
      const Sample last = nearest(friction_);  // a start, though of the basis before
      known_.erase(known_.begin() + 2, known_.end());
      known_.push_back(last);
      ask(Phase::left, std::max(event_.low, friction_ - 1e-5 * width()));
    }
  }
  /// The friction of which the problem is needed; none: it is located, or cannot be.
  std::optional<double> asks() const { return asked_; }
  /// The problem asked for; null: there is none.
  void take(const DenseProblem* problem) {
    const double at = *asked_, value = problem ? valueIn(*problem, at) : NAN;
    if (std::isnan(value)) return finish(NAN);
    switch (phase_) {
      case Phase::low:
        return ask(Phase::high, event_.high);
      case Phase::high:
        return searchAll(roughly());
      case Phase::left:
        return ask(Phase::right, std::min(event_.high, friction_ + 1e-5 * width()));
      case Phase::right:
        slope_ = (value - known_[3].value) / (at - known_[3].friction);
        return step(at, value);
      case Phase::step:
        return step(at, value);
      case Phase::search:
        search_->take(value);
        return search_->done() ? finish(search_->root()) : ask(Phase::search, search_->next());
    }
  }

  bool settled() const { return settled_; }

  /// Where two eigenvalues are one, so is their vector.
  Located located() const {
    std::vector<DensePair> pairs = nearest(friction_).pairs();
    const Complex s = mean(pairs);
    pairs.resize(1);
    pairs[0].s = s;
    return {friction_, pairs};
  }
  void setBackwardError(double error) { backwardError_ = error; }

  Critical result() const {
    Critical result{event_.kind, event_.branch, event_.partner, friction_, 0, 0, event_.loss, 0, backwardError_, true};
    if (event_.low == event_.high) {
      result.angularFrequency = mean(event_.below).imag();
    } else if (std::isnan(friction_)) {
      result.converged = false;
      result.friction = 0.5 * (event_.low + event_.high);
      result.errorEstimate = 0.5 * (event_.high - event_.low);
      result.angularFrequency = 0.5 * (mean(event_.below) + mean(event_.above)).imag();
    } else {
      result.converged = moved_ <= tolerance_ * friction_;
      result.errorEstimate = moved_ + rootTolerance();
      result.angularFrequency = mean(nearest(friction_).pairs()).imag();
      result.slope = event_.kind == Event::Kind::coalescence ? -slope_ : slope_;
    }
    return result;
  }

 private:
  struct Sample {
    double friction, value;
    Spectrum spectrum;
    const std::vector<DensePair>& pairs() const { return spectrum.pairs(); }
  };

  double measure(const Spectrum& spectrum) const {
    const auto& pairs = spectrum.pairs();
    switch (event_.kind) {
      case Event::Kind::coalescence:
        return discriminant(pairs, spectrum.damped());
      case Event::Kind::divergence:
        return (pairs[0].s * pairs[0].s).real();
      case Event::Kind::crossing:
        return pairs[0].s.real();
    }
    return NAN;
  }

  const Sample& nearest(double friction) const {
    return *std::min_element(known_.begin(), known_.end(), [&](const Sample& a, const Sample& b) {
      return std::abs(a.friction - friction) < std::abs(b.friction - friction);
    });
  }

  /// Mean of the eigenvalues between the nearest known frictions on both sides.
  Complex expected(double friction) const {
    const Sample *below = &known_[0], *above = &known_[1];
    for (const auto& sample : known_) {
      if (sample.friction <= friction && sample.friction > below->friction) below = &sample;
      if (sample.friction >= friction && sample.friction < above->friction) above = &sample;
    }
    const double width = above->friction - below->friction, t = width > 0 ? (friction - below->friction) / width : 0;
    return (1 - t) * mean(below->pairs()) + t * mean(above->pairs());
  }

  double valueIn(const DenseProblem& problem, double friction) {
    std::optional<Spectrum> found;
    if (phase_ == Phase::low || phase_ == Phase::high)
      found.emplace(problem, phase_ == Phase::low ? event_.below : event_.above);
    else
      found = continuedIn(problem, nearest(friction).spectrum, expected(friction), event_.isolation);
    if (!found) return NAN;
    known_.push_back({friction, measure(*found), std::move(*found)});
    return known_.back().value;
  }

  double rootTolerance() const { return 1e-13 * std::max(std::abs(event_.high), std::abs(event_.low)); }

  double width() const { return event_.high - event_.low; }
  /// Good enough for a basis that is still to be improved; less would hide by how much it moves with the basis.
  double roughly() const { return 1e-7 * width(); }

  enum class Phase { low, high, search, left, right, step };
  void ask(Phase phase, double friction) {
    phase_ = phase;
    asked_ = friction;
  }

  void searchAll(double tolerance) {
    search_.emplace(event_.low, known_[0].value, event_.high, known_[1].value, tolerance);
    ask(Phase::search, search_->next());
  }

  /// From a value near the root by the slope there, which is of two frictions 2e-5 of the bracket apart.
  void step(double at, double value) {
    const double change = -value / slope_, next = at + change;
    const bool inside = next >= event_.low && next <= event_.high, closer = steps_ < 2 || std::abs(change) < 0.1 * lastChange_;
    if (!inside || !closer) return searchAll(rootTolerance());
    lastChange_ = std::abs(change);
    // A step is wrong by some 1e-4 of itself.
    if (++steps_ > 1 && lastChange_ <= 1e3 * rootTolerance()) return finish(next);
    ask(Phase::step, next);
  }

  void finish(double friction) {
    asked_.reset();
    friction_ = friction;
    const bool first = std::isnan(before_);
    moved_ = first ? roughly() : changed_ ? std::abs(friction_ - before_) : 0;
    settled_ = std::isnan(friction_) || (!first && moved_ <= tolerance_ * friction_);
  }

  const Event& event_;
  double tolerance_, friction_ = NAN, before_ = NAN, moved_ = 0, backwardError_ = 0, slope_ = 0, lastChange_ = 0;
  bool settled_ = false, changed_ = false;
  std::vector<Sample> known_;  // the two ends first, then what the last basis left
  Phase phase_ = Phase::low;
  int steps_ = 0;
  std::optional<double> asked_;
  std::optional<Search> search_;
};

/// All events, spread over the ranks.
class Roots {
 public:
  Roots(Family& family, const std::vector<Event>& events, double tolerance) : family_(family) {
    check(MPI_Comm_rank(family.comm(), &rank_));
    check(MPI_Comm_size(family.comm(), &ranks_));
    for (const auto& event : events) roots_.emplace_back(event, tolerance);
    locate(indices(events.size()), true);
  }

  /// Indices of those that are not settled.
  std::vector<std::size_t> open() const {
    std::vector<int> is(roots_.size(), 0);
    for (std::size_t i = 0; i < roots_.size(); ++i) is[i] = mine(i) && !roots_[i].settled() ? 1 : 0;
    check(MPI_Allreduce(MPI_IN_PLACE, is.data(), static_cast<int>(is.size()), MPI_INT, MPI_MAX, family_.comm()));
    auto list = indices(roots_.size());
    std::erase_if(list, [&](auto i) { return is[i] == 0; });
    return list;
  }

  /// False: the basis has not changed.
  bool improve(const std::vector<std::size_t>& open) {
    std::vector<Located> located;
    for (const auto i : open) {
      Located item = mine(i) ? roots_[i].located() : Located{};
      int size = static_cast<int>(item.pairs.empty() ? 0 : item.pairs[0].q.size());
      check(MPI_Bcast(&size, 1, MPI_INT, owner(i), family_.comm()));
      check(MPI_Bcast(&item.friction, 1, MPI_DOUBLE, owner(i), family_.comm()));
      shareFrom(owner(i), family_.comm(), item.pairs, size, Vectors::both);
      located.push_back(std::move(item));
    }
    const Improvement improvement = family_.improve(located);
    for (std::size_t k = 0; k < improvement.backwardError.size(); ++k)
      roots_[open[k]].setBackwardError(improvement.backwardError[k]);
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
  int owner(std::size_t i) const { return static_cast<int>(i % static_cast<std::size_t>(ranks_)); }
  bool mine(std::size_t i) const { return owner(i) == rank_; }

  /// In step, since the problem at a friction may take all ranks.
  void locate(const std::vector<std::size_t>& open, bool changed) {
    for (const auto i : open)
      if (mine(i)) roots_[i].begin(changed);
    for (;;) {
      std::vector<double> asked(open.size(), -INFINITY);
      for (std::size_t k = 0; k < open.size(); ++k)
        if (mine(open[k])) asked[k] = roots_[open[k]].asks().value_or(-INFINITY);
      check(MPI_Allreduce(MPI_IN_PLACE, asked.data(), static_cast<int>(asked.size()), MPI_DOUBLE, MPI_MAX, family_.comm()));
      if (std::none_of(asked.begin(), asked.end(), [](double f) { return std::isfinite(f); })) return;
      std::string failure;
      for (std::size_t k = 0; k < open.size(); ++k) {
        if (!std::isfinite(asked[k]) || (family_.local() && !mine(open[k]))) continue;
        const auto problem = family_.at(asked[k]);
        if (mine(open[k]) && failure.empty()) try {
            roots_[open[k]].take(problem ? &*problem : nullptr);
          } catch (const Error& error) {
            failure = error.what();
          }
      }
      failTogether(family_.comm(), failure);
    }
  }

  Family& family_;
  int rank_ = 0, ranks_ = 1;
  std::vector<Root> roots_;
};

}  // namespace

std::vector<Critical> criticalFrictions(Family& family, const Branches& branches, double tolerance) {
  constexpr int rounds = 10;
  Roots roots(family, branches.events, tolerance);
  for (int round = 0; round < rounds; ++round) {
    const auto open = roots.open();
    family.progress(formatted("%zu of %zu critical frictions to be improved", open.size(), branches.events.size()));
    if (open.empty() || !roots.improve(open)) break;
  }
  auto list = roots.results();
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.friction < b.friction; });
  return list;
}

}  // namespace squeal::flutter
