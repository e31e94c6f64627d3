// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The record of a march: averages over windows of cycles, the spectrum, and the resulting kind of
/// regime [M.74].
#include <span>
#include <vector>

#include "base/checkpoint/archive.hpp"
#include "base/system/termination.hpp"
#include "regime/march/model.hpp"
#include "regime/march/scheme.hpp"
#include "regime/regime/signals.hpp"
#include "regime/regime/windows.hpp"

namespace squeal::regime {

/// The kind of the motion at the end of a march.
enum class Kind {
  unmeasured,  ///< the march ended before its first window
  growing,     ///< linear growth: no node has separated or stuck
  steady,      ///< it has decayed
  periodic,    ///< all cycles are equal
  modulated,   ///< cycles differ, and their differences repeat
  irregular    ///< cycles differ without repetition
};
const char* text(Kind kind);

/// The result of a march; without measurements, only the duration is set.
struct Regime {
  Kind kind = Kind::unmeasured;
  bool measured() const { return kind != Kind::unmeasured; }
  bool settled = false;        ///< means and peaks no longer change from window to window
  double duration = 0;         ///< s
  double carrier = 0;          ///< Hz
  double modulation = 0;       ///< Hz; 0: none
  double growth = 0;           ///< measured in the linear range, 1/s; NaN: too short
  double peakDeviation = 0;    ///< standard deviation of the peaks of the cycles over their mean
  double largestKinetic = 0;   ///< J
  double largestVelocity = 0;  ///< of a slip, about steady sliding, m/s
  double largestJump = 0;      ///< change of a gap, m
  double largestDefect = 0;    ///< of contact and friction in any step, over the mean force
  double imbalance = 0;        ///< of energy, over the work of the contact forces
  Means means;                 ///< over the last two thirds of the nonlinear motion
  std::vector<NodeMeans> nodes;
  std::vector<double> cyclePeaks;  ///< [cycle] largest kinetic energy, J
  std::vector<SpectralLine> spectrum;
};

/// Writes or reads the regime.
void fields(Stream& stream, Regime& regime);

/// The largest kinetic energies of the cycles of a march, J.
class CyclePeaks {
 public:
  /// The period of a cycle, s.
  explicit CyclePeaks(double period) : period_(period), end_(period) {}
  /// Returns the end of the current cycle, s.
  double end() const { return end_; }
  void add(double kinetic);
  void endCycle();
  const std::vector<double>& values() const { return values_; }
  /// Returns the growth rate of the first cycles, up to a level, J; NaN for fewer than four.
  double growthBelow(double level) const;

 private:
  double period_, end_, highest_ = 0;
  std::vector<double> values_, times_;
};

/// The record of a march, step by step.
class Recorder {
 public:
  /// The motion starts on a mode u e^{st}, whose period defines the cycles. Its first event is at
  /// the kinetic energy `linearTo`, J.
  Recorder(const ReducedModel& model, Complex s, double step, double linearTo);
  void inspect(const Scheme& scheme);
  /// Returns true once a window has ended since the last call.
  bool windowEnded();
  /// Returns true if the regime has settled, or the motion has decayed.
  bool settled() const;
  int cycles() const { return std::ssize(peaks_.values()); }
  /// Returns the number of latest windows for the averages: two thirds of the windows since the
  /// last linear one.
  std::size_t windowsUsed() const;
  /// Throws Interrupted, only on this rank, once stopRequested() is true.
  Regime result(const Scheme& scheme, const StopRequested& stopRequested = {}) const;
  /// Returns the modal velocities of the spectrum, samples × modes.
  DenseMatrix velocities() const { return signals_.latest(samplesUsed()); }
  double sampleTime() const { return signals_.sampleTime(); }
  /// The number of cycles of a window.
  static constexpr int windowCycles = 32;

 private:
  std::span<const double> lastPeaks(std::size_t windows) const;
  bool decayed() const;
  Kind classify(Regime& regime, const StopRequested& stopRequested) const;
  void addMeans(Regime& regime) const;
  std::size_t nonlinearWindows() const;
  std::size_t samplesUsed() const;

  double period_, growthTime_, linearTo_;
  CyclePeaks peaks_;
  WindowRecorder recorder_;
  ModalSignals signals_;
  double largestDefect_ = 0, energyAtStart_ = 0;
  bool first_ = true, ended_ = false;
};

}  // namespace squeal::regime
