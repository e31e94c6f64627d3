// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Starting points for shooting. If a time integration oscillates about an unstable periodic
/// motion, two states are near that motion: the mean of the states at which the time integration
/// passes a section, and the pass that differs least from the preceding pass.
#include <utility>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "regime/cycles/passage.hpp"

namespace squeal::cycles {

/// A state at which a time integration passes a section.
struct Pass {
  InitialState state;
  std::vector<double> acceleration;  ///< modal accelerations
  double period = 0;                 ///< time since the preceding pass, s
};

/// The passes within a span of time.
struct Passes {
  int count = 0;
  Pass sum;
  /// The pass with the smallest relative difference from the preceding one, in the energy norm. Two
  /// passes are compared only if a node has left its steady state (open, sticking or sliding)
  /// between them. Without this condition, passes of a slowly growing linear motion would win.
  Pass nearest;
  double change = -1;  ///< relative difference of `nearest` from the pass before it; −1: none
  void add(const Passes& other);
};

/// Write or read the passes.
void fields(Stream& stream, Passes& passes);
void fields(Stream& stream, Pass& pass);

/// The section of the state space at which the coordinate of a mode passes zero upwards.
class Section {
 public:
  /// Borrows the model. `q` are the coordinates of the mode, and `period` is its period, s.
  Section(const ReducedModel& model, const std::vector<Complex>& q, double period);
  /// Call it after each step.
  void inspect(const march::Massless& scheme);
  /// Returns the passes since the last call.
  Passes take() { return std::exchange(passes_, {}); }

 private:
  const ReducedModel& model_;
  std::vector<double> weight_;  // weights of q in the coordinate of the mode
  double period_, before_ = 0, lastTime_ = 0, lastPassTime_ = -1;
  bool linear_ = true;  // since the last pass
  InitialState last_;   // state after the last step
  InitialState lastPass_;
  Passes passes_;
};

/// Returns the initial orbits for shooting: one from the mean of the passes and, if `nearest` is
/// set, one from it. A period of an orbit has `steps` steps. `step` is the time step of the time
/// integration, s. Does not set Orbit::friction.
std::vector<Orbit> firstOrbits(const Passes& passes, double step, int steps);

}  // namespace squeal::cycles
