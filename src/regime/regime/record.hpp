// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The record of a time integration: averages over windows of cycles, the spectrum, and the
/// resulting kind of regime [M.74].
#include <span>
#include <vector>

#include "base/checkpoint/archive.hpp"
#include "base/system/termination.hpp"
#include "regime/march/model.hpp"
#include "regime/march/scheme.hpp"
#include "regime/regime/signals.hpp"
#include "regime/regime/windows.hpp"

namespace squeal::regime {

/// The kind of the motion at the end of a time integration.
enum class Kind {
  unmeasured,  ///< the time integration ended before its first window
  growing,     ///< the last window is linear, and the motion has grown since the first one
  steady,      ///< the last window is linear, and the motion has decayed
  periodic,    ///< the standard deviation of the peaks is below 1 % of their mean
  modulated,   ///< the peaks vary from cycle to cycle, and their variation repeats
  irregular    ///< the peaks vary without repetition
};
const char* text(Kind kind);

/// The result of a time integration. If the kind is `unmeasured`, only the duration is set.
struct Regime {
  Kind kind = Kind::unmeasured;
  bool measured() const { return kind != Kind::unmeasured; }
  bool settled = false;        ///< the motion has decayed, or its means no longer change
  double duration = 0;         ///< s
  double carrier = 0;          ///< strongest frequency, Hz
  double modulation = 0;       ///< frequency of the modulation, Hz; 0: none
  double growth = 0;           ///< growth rate in the linear range, 1/s; NaN: too few cycles
  double peakDeviation = 0;    ///< standard deviation of the peaks of the cycles / their mean
  double largestKinetic = 0;   ///< J
  double largestVelocity = 0;  ///< of a slip, relative to steady sliding, m/s
  double largestJump = 0;      ///< of a gap, relative to steady sliding, m
  double largestDefect = 0;    ///< Scheme::lastDefect() of any step / mean normal force
  double imbalance = 0;        ///< error of the energy balance / MechanicalWork::moved
  Means means;                 ///< over the last two thirds of the nonlinear motion
  std::vector<NodeMeans> nodes;
  std::vector<double> cyclePeaks;  ///< [cycle] largest kinetic energy, J
  std::vector<SpectralLine> spectrum;
};

/// Writes or reads the regime.
void fields(Stream& stream, Regime& regime);

/// The largest kinetic energy of each cycle of a time integration, J.
class CyclePeaks {
 public:
  /// `period` is the period of a cycle, s.
  explicit CyclePeaks(double period) : period_(period), end_(period) {}
  /// Returns the end of the current cycle, s.
  double end() const { return end_; }
  void add(double kinetic);
  void endCycle();
  const std::vector<double>& values() const { return values_; }
  /// Returns the growth rate over the cycles before the first one that reaches `level`, J; NaN if
  /// these are fewer than four.
  double growthBelow(double level) const;

 private:
  double period_, end_, highest_ = 0;
  std::vector<double> values_, times_;
};

/// Records a time integration, step by step.
class Recorder {
 public:
  /// The motion starts on a mode u e^{st}, whose period defines the cycles. A node first separates,
  /// sticks or slides (march/onset.hpp) at the kinetic energy `linearTo`, J.
  Recorder(const ReducedModel& model, Complex s, double step, double linearTo);
  void inspect(const Scheme& scheme);
  /// Returns true if a window has ended since the last call.
  bool windowEnded();
  /// Returns true if the means no longer change, or if the motion has decayed.
  bool settled() const;
  int cycles() const { return std::ssize(peaks_.values()); }
  /// Returns the number of latest windows to average: two thirds of those after the last linear
  /// window, or one if the last window is linear.
  std::size_t windowsUsed() const;
  /// Returns the result so far. Throws Interrupted, only on this rank, once stopRequested() is
  /// true.
  Regime result(const Scheme& scheme, const StopRequested& stopRequested = {}) const;
  /// Returns the modal velocities from which the spectrum is computed, samples × modes.
  DenseMatrix velocities() const { return signals_.latest(samplesUsed()); }
  double sampleTime() const { return signals_.sampleTime(); }
  /// The number of cycles in a window.
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
