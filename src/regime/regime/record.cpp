// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/record.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/check.hpp"
#include "regime/regime/statistics.hpp"
#include "regime/sound/spectrum.hpp"

namespace squeal::regime {
namespace {

/// Returns the peaks without mean and linear trend: a slow drift is not a modulation.
std::vector<double> withoutDrift(std::span<const double> peaks) {
  const std::size_t count = peaks.size();
  const double level = mean(peaks);
  std::vector<double> swing(peaks.begin(), peaks.end());
  double drift = 0, spread = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = i - (count - 1) / 2.0;
    drift += place * swing[i], spread += place * place;
  }
  for (std::size_t i = 0; i < count; ++i)
    swing[i] -= level + drift / spread * (i - (count - 1) / 2.0);
  return swing;
}

/// Returns the largest autocorrelation after its first negative value: the fraction of the variance
/// that repeats later, also for modulations by several frequencies. Throws Interrupted, only on
/// this rank, once stopRequested() is true.
double repetition(const std::vector<double>& swing, const StopRequested& stopRequested) {
  const std::size_t count = swing.size();
  double best = 0;
  bool forgotten = false;
  for (std::size_t shift = 1; shift <= count / 3; ++shift) {
    if (stopRequested && stopRequested()) throw Interrupted();  // a long march has many cycles
    double both = 0, a = 0, b = 0;
    for (std::size_t i = 0; i + shift < count; ++i) {
      both += swing[i] * swing[i + shift];
      a += swing[i] * swing[i], b += swing[i + shift] * swing[i + shift];
    }
    if (both < 0) forgotten = true;
    if (forgotten) best = std::max(best, both / std::sqrt(a * b));
  }
  return best;
}

}  // namespace

const char* text(Kind kind) {
  constexpr const char* texts[] = {"nothing measured", "growing",   "steady",
                                   "periodic",         "modulated", "irregular"};
  return texts[static_cast<int>(kind)];
}

// This lists all members: a new one does not compile until it is added here.
void fields(Stream& stream, Regime& regime) {
  auto& [kind, settled, duration, carrier, modulation, growth, peakDeviation, largestKinetic,
         largestVelocity, largestJump, largestDefect, imbalance, means, nodes, cyclePeaks,
         spectrum] = regime;
  stream(kind, settled, duration, carrier, modulation, growth, peakDeviation, largestKinetic,
         largestVelocity, largestJump, largestDefect, imbalance, means, nodes, cyclePeaks,
         spectrum);
}

void CyclePeaks::add(double kinetic) { highest_ = std::max(highest_, kinetic); }

void CyclePeaks::endCycle() {
  values_.push_back(highest_);
  times_.push_back(end_ - period_ / 2);
  highest_ = 0;
  end_ += period_;
}

double CyclePeaks::growthBelow(double level) const {
  std::vector<double> t, logarithm;
  for (std::size_t i = 0; i < values_.size() && values_[i] < level; ++i)
    t.push_back(times_[i]), logarithm.push_back(0.5 * std::log(values_[i]));
  if (t.size() < 4) return NAN;
  const double tm = mean(t), lm = mean(logarithm);
  double above = 0, below = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    above += (t[i] - tm) * (logarithm[i] - lm), below += (t[i] - tm) * (t[i] - tm);
  return above / below;
}

Recorder::Recorder(const ReducedModel& model, Complex s, double step, double linearTo)
    : period_(2 * M_PI / s.imag()),
      growthTime_(1 / s.real()),
      linearTo_(linearTo),
      peaks_(period_),
      recorder_(model),
      signals_(model.modes(), period_, step) {}

void Recorder::inspect(const Scheme& scheme) {
  const march::State& state = scheme.state();
  if (first_) energyAtStart_ = scheme.energy() - scheme.work().contact + scheme.work().damping;
  first_ = false;
  if (state.time >= peaks_.end()) {
    peaks_.endCycle();
    if (cycles() % windowCycles == 0) {
      recorder_.end(state.time, mean(std::span(peaks_.values()).last(windowCycles)));
      ended_ = true;
    }
  }
  peaks_.add(state.kinetic);
  recorder_.inspect(scheme);
  largestDefect_ = std::max(largestDefect_, scheme.lastDefect() / recorder_.meanForce());
  signals_.add(state.v);
}

bool Recorder::windowEnded() { return std::exchange(ended_, false); }

/// Returns the number of windows since the last linear one.
std::size_t Recorder::nonlinearWindows() const {
  const auto& windows = recorder_.windows();
  const auto last = std::find_if(windows.rbegin(), windows.rend(),
                                 [](const Window& window) { return window.means.linear; });
  return last - windows.rbegin();
}

std::size_t Recorder::windowsUsed() const {
  const std::size_t nonlinear = nonlinearWindows();
  return nonlinear == 0 ? std::min<std::size_t>(1, recorder_.windows().size())
                        : (2 * nonlinear + 2) / 3;
}

/// Returns the peaks of the last complete windows.
std::span<const double> Recorder::lastPeaks(std::size_t windows) const {
  return std::span(peaks_.values())
      .first(recorder_.windows().size() * windowCycles)
      .last(windows * windowCycles);
}

bool Recorder::decayed() const {
  const auto& windows = recorder_.windows();
  return windows.size() > 1 && windows.back().means.peakKinetic < 1e-6 * linearTo_ &&
         windows.back().means.peakKinetic < 0.5 * windows.front().means.peakKinetic;
}

bool Recorder::settled() const {
  if (decayed()) return true;
  // Once the mode has saturated, its amplitude changes no faster than its initial growth rate.
  const std::size_t third = nonlinearWindows() / 3;
  if (third < 3 || third * windowCycles * period_ < growthTime_) return false;
  // The last third must agree with the one before.
  const auto near = [&](double Means::*value, double tolerance) {
    const auto& windows = recorder_.windows();
    double before = 0, after = 0;
    for (std::size_t k = 1; k <= third; ++k) {
      after += windows.end()[-std::ptrdiff_t(k)].means.*value;
      before += windows.end()[-std::ptrdiff_t(third + k)].means.*value;
    }
    return std::abs(after - before) <= tolerance * std::max(std::abs(after), std::abs(before));
  };
  // The peaks of an irregular regime scatter. The error of their mean falls with the square root of
  // the number of independent cycles, assumed to be every eighth.
  const auto last = std::span(peaks_.values()).last(third * windowCycles);
  const double error = 3 * deviation(last) / mean(last) / std::sqrt(last.size() / 8.0);
  return near(&Means::peakKinetic, std::max(0.02, std::min(0.1, error))) &&
         near(&Means::frictionPower, 0.02) && near(&Means::frictionCoefficient, 0.02);
}

/// Returns the number of latest samples for spectra and mean squares.
std::size_t Recorder::samplesUsed() const {
  return signals_.count(windowsUsed() * windowCycles * period_);
}

/// Returns the kind of the regime, and sets the deviation of its peaks and its modulation.
Kind Recorder::classify(Regime& regime, const StopRequested& stopRequested) const {
  const auto peaks = lastPeaks(windowsUsed());
  const auto& windows = recorder_.windows();
  const double level = mean(peaks);
  regime.peakDeviation = level > 0 ? deviation(peaks) / level : 0;
  if (nonlinearWindows() == 0)
    return windows.back().means.peakKinetic < windows.front().means.peakKinetic ? Kind::steady
                                                                                : Kind::growing;
  // A cycle has at least 16 samples, so the sampling scatters the peaks by 1e-3.
  if (regime.peakDeviation < 0.01) return Kind::periodic;
  const auto swing = withoutDrift(peaks);
  std::vector<double> power;
  sound::addPower(swing, power);
  const double place = peakPlace(power, 1);
  if (repetition(swing, stopRequested) < 0.5) return Kind::irregular;
  regime.modulation = place / (peaks.size() * period_);
  return Kind::modulated;
}

/// Sets the means over the windows in use, at least one.
void Recorder::addMeans(Regime& regime) const {
  const std::size_t used = windowsUsed();
  const auto span = std::span(recorder_.windows()).last(used);
  regime.nodes.resize(span.front().nodes.size());
  regime.means.from = span.front().means.from, regime.means.to = span.back().means.to;
  regime.means.linear = span.back().means.linear;
  for (const Window& window : span) {
    for (double Means::*value : {&Means::kinetic, &Means::peakKinetic, &Means::frictionCoefficient,
                                 &Means::frictionPower, &Means::open, &Means::sticking})
      regime.means.*value += window.means.*value / used;
    for (std::size_t i = 0; i < regime.nodes.size(); ++i) {
      for (double NodeMeans::*value : {&NodeMeans::open, &NodeMeans::stick, &NodeMeans::slip,
                                       &NodeMeans::pressure, &NodeMeans::power})
        regime.nodes[i].*value += window.nodes[i].*value / used;
      regime.nodes[i].largestGap = std::max(regime.nodes[i].largestGap, window.nodes[i].largestGap);
    }
    regime.largestVelocity = std::max(regime.largestVelocity, window.largestVelocity);
    regime.largestJump = std::max(regime.largestJump, window.largestJump);
  }
  regime.largestKinetic = *std::ranges::max_element(lastPeaks(used));
}

Regime Recorder::result(const Scheme& scheme, const StopRequested& stopRequested) const {
  Regime regime;
  regime.duration = scheme.state().time;
  if (recorder_.windows().empty()) return regime;
  regime.settled = settled();
  regime.spectrum = signals_.spectrum(samplesUsed());
  regime.carrier = signals_.carrier(samplesUsed());
  regime.kind = classify(regime, stopRequested);
  regime.cyclePeaks = peaks_.values();
  // The linear range ends before a cycle approaches the first event.
  regime.growth = peaks_.growthBelow(0.9 * linearTo_);
  addMeans(regime);
  regime.largestDefect = largestDefect_;
  const march::MechanicalWork& work = scheme.work();
  regime.imbalance = std::abs(scheme.energy() - energyAtStart_ - work.contact + work.damping) /
                     std::max(work.moved, 1e-300);
  return regime;
}

}  // namespace squeal::regime
