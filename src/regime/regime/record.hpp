#pragma once
/// This file records a march: what each contact node does, cycle by cycle and in windows, the
/// spectrum, and the kind of regime that follows from them [M.74].
#include <mpi.h>

#include <string>
#include <vector>

#include "base/system/termination.hpp"
#include "regime/march/model.hpp"
#include "regime/march/scheme.hpp"

namespace squeal::regime {

using linalg::DenseMatrix;
using march::ReducedModel;
using march::Scheme;

/// The kind of the motion that is left after a march.
enum class Kind {
  unmeasured,  ///< the march has not come to the end of its first window
  growing,     ///< it still grows, linearly: nothing has opened or stuck
  steady,      ///< it has died away
  periodic,    ///< all cycles are alike
  modulated,   ///< cycles differ, and their differences repeat
  irregular    ///< cycles differ without repetition
};
const char* text(Kind kind);

/// Averages over a span of time.
struct Means {
  double from = 0, to = 0;         ///< s
  double kinetic = 0;              ///< mean kinetic energy, J
  double peakKinetic = 0;          ///< mean of the largest kinetic energies of the cycles, J
  double frictionCoefficient = 0;  ///< −Σ R_T·τ / Σ R_N of all sliding interfaces
  double frictionPower = 0;        ///< −Σ R_T·w, W
  double open = 0, sticking = 0;   ///< mean numbers of nodes that are open, and that stick
  bool linear = true;              ///< no node has opened, closed, come to rest or begun to slide
};

/// What one node does, over the same span.
struct NodeMeans {
  double open = 0, stick = 0, slip = 0;  ///< fractions of the time
  double pressure = 0;                   ///< mean, Pa
  double largestGap = 0;                 ///< m
  double power = 0;                      ///< heat of friction, W
};

/// One line of a spectrum: amplitudes of velocity, 0 to peak.
struct SpectralLine {
  double frequency = 0;  ///< Hz
  double whole = 0;      ///< √(2 kinetic energy / mass of the model), m/s·√kg
};

/// The result of a march; only the duration where it has measured nothing.
struct Regime {
  Kind kind = Kind::unmeasured;
  bool measured() const { return kind != Kind::unmeasured; }
  bool settled = false;        ///< means and peaks no longer change from window to window
  double duration = 0;         ///< s
  double carrier = 0;          ///< Hz
  double modulation = 0;       ///< Hz; 0: none
  double growth = 0;           ///< measured in the linear range, 1/s; NaN: too short
  double peakDeviation = 0;    ///< standard deviation of the cycles' peaks over their mean
  double largestKinetic = 0;   ///< J
  double largestVelocity = 0;  ///< of a slip, about steady sliding, m/s
  double largestJump = 0;      ///< change of a gap, m
  double largestDefect = 0;    ///< of contact and friction in any step, over the mean force
  double imbalance = 0;        ///< of energy, over the work of the contact forces
  Means means;                 ///< over the last two thirds of what is not linear
  std::vector<NodeMeans> nodes;
  std::vector<double> cyclePeaks;  ///< [cycle] largest kinetic energy, J
  std::vector<SpectralLine> spectrum;
};

/// Collective. Sends a regime from the rank `root` to all ranks.
void share(MPI_Comm comm, int root, Regime& regime);

/// A Recorder looks at each step of a march.
class Recorder {
 public:
  /// The motion starts on a mode u e^{st}, whose period is that of the cycles and whose first event
  /// comes at the kinetic energy `linearTo`, J.
  Recorder(const ReducedModel& model, Complex s, double step, double linearTo);
  void look(const Scheme& scheme);
  /// Returns true once a window has ended since the last call.
  bool windowEnded();
  /// Returns true if the regime has settled, or the motion has died away.
  bool settled() const;
  int cycles() const { return std::ssize(peaks_); }
  /// Returns the number of windows, the last ones, over which averages are taken: two thirds of
  /// those since the last linear one.
  std::size_t windowsUsed() const;
  /// Throws Interrupted, on this rank alone, once asked() is true.
  Regime result(const Scheme& scheme, const StopAsked& asked = {}) const;
  /// Returns the modal velocities of which the spectrum is made, samples × modes, and the time from
  /// sample to sample, s.
  DenseMatrix velocities() const;
  double sampleTime() const { return stride_ * step_; }
  /// The number of cycles of a window.
  static constexpr int windowCycles = 32;

 private:
  void endCycle(double time);
  Kind classify(Regime& regime, const StopAsked& asked) const;
  void addMeans(Regime& regime) const;
  double linearGrowth() const;
  double carrier(Regime& regime) const;
  std::size_t nonlinearWindows() const;
  std::size_t samplesUsed() const;

  /// What one window holds.
  struct Window {
    Means means;
    std::vector<NodeMeans> nodes;
    double largestVelocity = 0, largestJump = 0;
  };
  const ReducedModel& model_;
  double period_, growthTime_, step_, linearTo_, meanForce_ = 0;
  double cycleEnd_, highest_ = 0;  // of the cycle in hand
  std::vector<double> peaks_, peakTimes_;
  std::vector<Window> windows_;  // complete ones
  Window window_;
  long steps_ = 0;  // in it
  double normalSum_ = 0, alongSum_ = 0;
  double largestDefect_ = 0, energyAtStart_ = 0;
  bool first_ = true, ended_ = false;
  std::vector<std::vector<double>> signals_;  // [mode] velocities, every `stride_` steps
  int stride_;
  long seen_ = 0;
};

}  // namespace squeal::regime
