#include "regime/regime/record.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>

#include "base/petsc/check.hpp"
#include "regime/sound/spectrum.hpp"

namespace squeal::regime {
namespace {

using march::Node;
using march::State;
using march::Work;
using sound::addPower;

double mean(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / std::max<std::size_t>(1, x.size());
}

double deviation(std::span<const double> x) {
  const double m = mean(x);
  double sum = 0;
  for (const double a : x) sum += (a - m) * (a - m);
  return std::sqrt(sum / std::max<std::size_t>(1, x.size()));
}

/// Returns the place of the largest entry of [first, end), refined by a parabola through its
/// neighbours' logarithms.
double peakPlace(std::span<const double> power, std::size_t first) {
  const std::size_t i = std::max_element(power.begin() + first, power.end()) - power.begin();
  if (i == 0 || i + 1 >= power.size() || power[i - 1] <= 0 || power[i + 1] <= 0) return i;
  const double a = std::log(power[i - 1]), b = std::log(power[i]), c = std::log(power[i + 1]);
  const double curvature = a - 2 * b + c;
  return i + (curvature < 0 ? 0.5 * (a - c) / curvature : 0);
}

}  // namespace

const char* text(Kind kind) {
  switch (kind) {
    case Kind::unmeasured:
      return "nothing measured";
    case Kind::growing:
      return "growing";
    case Kind::steady:
      return "steady";
    case Kind::periodic:
      return "periodic";
    case Kind::modulated:
      return "modulated";
    case Kind::irregular:
      return "irregular";
  }
  return "";
}

Recorder::Recorder(const ReducedModel& model, Complex s, double step, double linearTo)
    : model_(model),
      period_(2 * M_PI / s.imag()),
      growthTime_(1 / s.real()),
      step_(step),
      linearTo_(linearTo),
      cycleEnd_(period_),
      signals_(model.modes()),
      stride_(std::max(1, int(period_ / 16 / step))) {
  int pressed = 0;
  for (const Node& node : model.nodes) meanForce_ += node.normalForce, pressed += node.pressed();
  meanForce_ /= std::max(1, pressed);
  window_.nodes.resize(model.nodes.size());
}

void Recorder::look(const Scheme& scheme) {
  const State& state = scheme.state();
  if (first_) energyAtStart_ = scheme.energy() - scheme.work().contact + scheme.work().damping;
  first_ = false;
  if (state.time >= cycleEnd_) endCycle(state.time);
  highest_ = std::max(highest_, state.kinetic);
  ++steps_;
  Means& all = window_.means;
  all.kinetic += state.kinetic;
  for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
    const PetscInt row = i * model_.dimension;
    const Node& node = model_.nodes[i];
    NodeMeans& means = window_.nodes[i];
    const double normal = state.force[row];
    double heat = 0, shear = 0, change = 0;  // the last two squared
    for (int c = 1; c < model_.dimension; ++c) {
      const double w = state.rate[row + c], w0 = node.velocity[c - 1];
      const double t = state.force[row + c];
      heat -= t * w;
      shear += t * t, change += (w - w0) * (w - w0);
    }
    // A node that slides has its friction on the cone, up to the accuracy of the forces.
    const bool open = normal == 0,
               sticks = !open && node.rubs() &&
                        std::sqrt(shear) < scheme.friction()[i] * (normal - 1e-5 * meanForce_);
    means.open += open, means.stick += sticks, means.slip += !open && !sticks;
    all.open += open, all.sticking += sticks;
    if (open == node.pressed() || (!open && node.rubs() && sticks != node.sticks()))
      all.linear = false;
    means.pressure += normal;
    means.largestGap = std::max(means.largestGap, node.gap + state.jump[row]);
    means.power += heat;
    all.frictionPower += heat;
    normalSum_ += normal;
    if (!node.sticks()) alongSum_ -= state.force[row + 1];
    window_.largestJump = std::max(window_.largestJump, std::abs(state.jump[row]));
    window_.largestVelocity = std::max(window_.largestVelocity, std::sqrt(change));
  }
  largestDefect_ = std::max(largestDefect_, scheme.lastDefect() / meanForce_);
  if (++seen_ % stride_ != 0) return;
  constexpr std::size_t mostSamples = 32 * 1024;  // of the latest thousand cycles at least
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    auto& signal = signals_[i];
    if (signal.size() >= mostSamples)
      signal.erase(signal.begin(), signal.begin() + mostSamples / 2);
    signal.push_back(state.v[i]);
  }
}

void Recorder::endCycle(double time) {
  peaks_.push_back(highest_);
  peakTimes_.push_back(cycleEnd_ - period_ / 2);
  highest_ = 0;
  cycleEnd_ += period_;
  if (peaks_.size() % windowCycles != 0) return;
  Means& all = window_.means;
  all.to = time;
  for (double* sum : {&all.kinetic, &all.frictionPower, &all.open, &all.sticking}) *sum /= steps_;
  all.frictionCoefficient = normalSum_ > 0 ? alongSum_ / normalSum_ : 0;
  all.peakKinetic = mean(std::span(peaks_).last(windowCycles));
  for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
    NodeMeans& node = window_.nodes[i];
    for (double* sum : {&node.open, &node.stick, &node.slip, &node.power}) *sum /= steps_;
    node.pressure /= steps_ * model_.nodes[i].area;
  }
  Window next;
  next.means.from = time;
  next.nodes.resize(model_.nodes.size());
  windows_.push_back(std::exchange(window_, std::move(next)));
  normalSum_ = alongSum_ = 0;
  steps_ = 0;
  ended_ = true;
}

bool Recorder::windowEnded() { return std::exchange(ended_, false); }

/// Returns the number of windows since the last linear one.
std::size_t Recorder::nonlinearWindows() const {
  const auto last = std::find_if(windows_.rbegin(), windows_.rend(),
                                 [](const Window& window) { return window.means.linear; });
  return last - windows_.rbegin();
}

std::size_t Recorder::windowsUsed() const {
  const std::size_t nonlinear = nonlinearWindows();
  return nonlinear == 0 ? std::min<std::size_t>(1, windows_.size()) : (2 * nonlinear + 2) / 3;
}

bool Recorder::settled() const {
  if (windows_.size() > 1 && windows_.back().means.peakKinetic < 1e-6 * linearTo_ &&
      windows_.back().means.peakKinetic < 0.5 * windows_.front().means.peakKinetic)
    return true;  // it has died away
  // What is left when the growth of the mode has ended changes no faster than it grew.
  const std::size_t third = nonlinearWindows() / 3;
  if (third < 3 || third * windowCycles * period_ < growthTime_) return false;
  // The last third is like the one before.
  const auto near = [&](double Means::*value, double tolerance) {
    double before = 0, after = 0;
    for (std::size_t k = 1; k <= third; ++k) {
      after += windows_.end()[-std::ptrdiff_t(k)].means.*value;
      before += windows_.end()[-std::ptrdiff_t(third + k)].means.*value;
    }
    return std::abs(after - before) <= tolerance * std::max(std::abs(after), std::abs(before));
  };
  // The peaks of an irregular regime scatter: their means by the root of the number of cycles that
  // do not remember each other, taken as one in eight.
  const auto last = std::span(peaks_).last(third * windowCycles);
  const double error = 3 * deviation(last) / mean(last) / std::sqrt(last.size() / 8.0);
  return near(&Means::peakKinetic, std::max(0.02, std::min(0.1, error))) &&
         near(&Means::frictionPower, 0.02) && near(&Means::frictionCoefficient, 0.02);
}

/// Returns the number of latest samples over which spectra and mean squares are taken.
std::size_t Recorder::samplesUsed() const {
  const std::size_t wanted = windowsUsed() * windowCycles * period_ / sampleTime(),
                    count = signals_.empty() ? 0 : std::min(wanted, signals_[0].size());
  return count < 8 ? 0 : count;
}

DenseMatrix Recorder::velocities() const {
  DenseMatrix result(samplesUsed());
  for (const auto& signal : signals_) result.append(std::span(signal).last(samplesUsed()));
  return result;
}

/// Sets spectrum and returns the carrier.
double Recorder::carrier(Regime& regime) const {
  const std::size_t count = samplesUsed();
  if (count == 0) return 0;
  std::vector<double> power;
  for (const auto& signal : signals_) addPower(std::span(signal).last(count), power);
  const double line = 1 / (count * sampleTime());
  for (std::size_t i = 0; i < power.size(); ++i)
    regime.spectrum.push_back({i * line, std::sqrt(power[i])});
  return line * peakPlace(power, 2);
}

Kind Recorder::classify(Regime& regime, const StopAsked& asked) const {
  const std::size_t count = windowsUsed() * windowCycles;
  const auto peaks = std::span(peaks_).first(windows_.size() * windowCycles).last(count);
  const double level = mean(peaks);
  regime.peakDeviation = level > 0 ? deviation(peaks) / level : 0;
  if (nonlinearWindows() == 0)
    return windows_.back().means.peakKinetic < windows_.front().means.peakKinetic ? Kind::steady
                                                                                  : Kind::growing;
  // Peaks of cycles are sampled some 16 times a swing at least, which alone makes 1e-3 of scatter.
  if (regime.peakDeviation < 0.01) return Kind::periodic;
  std::vector<double> power, swing(peaks.begin(), peaks.end());
  // A slow drift is no modulation: the straight line through the peaks is taken out.
  double drift = 0, spread = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = i - (count - 1) / 2.0;
    drift += place * swing[i], spread += place * place;
  }
  for (std::size_t i = 0; i < count; ++i)
    swing[i] -= level + drift / spread * (i - (count - 1) / 2.0);
  addPower(swing, power);
  const double place = peakPlace(power, 1);
  // The part of the variance that repeats at some later time, once cycles have ceased to be like
  // those before them: of a modulation by several frequencies too.
  double best = 0;
  bool forgotten = false;
  for (std::size_t shift = 1; shift <= count / 3; ++shift) {
    if (asked && asked()) throw Interrupted();  // a long march has many cycles
    double both = 0, a = 0, b = 0;
    for (std::size_t i = 0; i + shift < count; ++i) {
      both += swing[i] * swing[i + shift];
      a += swing[i] * swing[i], b += swing[i + shift] * swing[i + shift];
    }
    if (both < 0) forgotten = true;
    if (forgotten) best = std::max(best, both / std::sqrt(a * b));
  }
  if (best < 0.5) return Kind::irregular;
  regime.modulation = place / (count * period_);
  return Kind::modulated;
}

/// Returns the growth rate in the linear range: while no cycle has come near the first event.
double Recorder::linearGrowth() const {
  std::vector<double> t, logarithm;
  for (std::size_t i = 0; i < peaks_.size() && peaks_[i] < 0.9 * linearTo_; ++i)
    t.push_back(peakTimes_[i]), logarithm.push_back(0.5 * std::log(peaks_[i]));
  if (t.size() < 4) return NAN;
  const double tm = mean(t), lm = mean(logarithm);
  double above = 0, below = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    above += (t[i] - tm) * (logarithm[i] - lm), below += (t[i] - tm) * (t[i] - tm);
  return above / below;
}

/// Sets the means over the windows that are used, of which there is at least one.
void Recorder::addMeans(Regime& regime) const {
  const std::size_t used = windowsUsed();
  const auto span = std::span(windows_).last(used);
  regime.nodes.resize(model_.nodes.size());
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
  regime.largestKinetic = *std::ranges::max_element(
      std::span(peaks_).first(windows_.size() * windowCycles).last(used * windowCycles));
}

Regime Recorder::result(const Scheme& scheme, const StopAsked& asked) const {
  Regime regime;
  regime.duration = scheme.state().time;
  if (windows_.empty()) return regime;
  regime.settled = settled();
  regime.carrier = carrier(regime);
  regime.kind = classify(regime, asked);
  regime.cyclePeaks = peaks_;
  regime.growth = linearGrowth();
  addMeans(regime);
  regime.largestDefect = largestDefect_;
  const Work& work = scheme.work();
  regime.imbalance = std::abs(scheme.energy() - energyAtStart_ - work.contact + work.damping) /
                     std::max(work.moved, 1e-300);
  return regime;
}

void share(MPI_Comm comm, int root, Regime& regime) {
  const auto send = [&](auto& value) {
    static_assert(std::is_trivially_copyable_v<std::remove_reference_t<decltype(value)>>);
    check(MPI_Bcast(&value, sizeof value, MPI_BYTE, root, comm));
  };
  const auto sendList = [&](auto& list) {
    std::size_t count = list.size();
    send(count);
    list.resize(count);
    check(MPI_Bcast(list.data(), count * sizeof list[0], MPI_BYTE, root, comm));
  };
  send(regime.kind), send(regime.settled), send(regime.means);
  for (double Regime::*value :
       {&Regime::duration, &Regime::carrier, &Regime::modulation, &Regime::growth,
        &Regime::peakDeviation, &Regime::largestKinetic, &Regime::largestVelocity,
        &Regime::largestJump, &Regime::largestDefect, &Regime::imbalance})
    send(regime.*value);
  sendList(regime.nodes), sendList(regime.cyclePeaks), sendList(regime.spectrum);
}

}  // namespace squeal::regime
