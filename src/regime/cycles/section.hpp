// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Starting points for shooting. If a march swings about an unstable periodic motion, two states
/// are near that motion: the mean of the states at which the march passes a section, and the pass
/// that comes nearest to the one before it.
#include <utility>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "regime/cycles/passage.hpp"

namespace squeal::cycles {

/// A state at which a march passes a section.
struct Pass {
  InitialState state;
  std::vector<double> acceleration;  ///< of the modes
  double period = 0;                 ///< since the pass before, s
};

/// The passes of a span of time.
struct Passes {
  int count = 0;
  Pass sum;
  /// The pass that differs least from the one before it, √J over √J. A node must have left its
  /// state of steady sliding between the two: linear motions that grow slowly come nearer.
  Pass nearest;
  double change = -1;  ///< of `nearest`; -1: there is none
  void add(const Passes& other);
};

/// Writes the passes to a stream, or reads them.
void fields(Stream& stream, Passes& passes);
void fields(Stream& stream, Pass& pass);

/// A Section is passed where the coordinate of a mode passes zero upwards.
class Section {
 public:
  /// The model is borrowed. The mode has the coordinates q and this period, s.
  Section(const ReducedModel& model, const std::vector<Complex>& q, double period);
  /// Is called after each step.
  void inspect(const march::Massless& scheme);
  /// Returns the passes since the last call.
  Passes take() { return std::exchange(passes_, {}); }

 private:
  const ReducedModel& model_;
  std::vector<double> weight_;  // of q, for the coordinate of the mode
  double period_, before_ = 0, lastTime_ = 0, lastPassTime_ = -1;
  bool linear_ = true;  // since the last pass
  InitialState last_;   // of the last step
  InitialState lastPass_;
  Passes passes_;
};

/// Returns the orbits to start from, the mean and the nearest if there is one, for periods of this
/// number of steps; `step` is that of the march, s. Their friction is not set.
std::vector<Orbit> firstOrbits(const Passes& passes, double step, int steps);

}  // namespace squeal::cycles
