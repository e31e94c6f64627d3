// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Starting points for shooting. If a march oscillates about an unstable periodic motion, two
/// states are near that motion: the mean of the states at which the march passes a section, and the
/// pass nearest to the preceding one.
#include <utility>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "regime/cycles/passage.hpp"

namespace squeal::cycles {

/// A state at which a march passes a section.
struct Pass {
  InitialState state;
  std::vector<double> acceleration;  ///< of the modes
  double period = 0;                 ///< since the preceding pass, s
};

/// The passes of a span of time.
struct Passes {
  int count = 0;
  Pass sum;
  /// The pass with the smallest relative difference from the preceding one, in the energy norm.
  /// Only passes between which a node has separated or stuck are compared, since slowly growing
  /// linear motions would differ even less.
  Pass nearest;
  double change = -1;  ///< of `nearest`; -1: there is none
  void add(const Passes& other);
};

/// Write or read the passes.
void fields(Stream& stream, Passes& passes);
void fields(Stream& stream, Pass& pass);

/// The section at which the coordinate of a mode passes zero upwards.
class Section {
 public:
  /// Borrows the model. The mode has the coordinates q and this period, s.
  Section(const ReducedModel& model, const std::vector<Complex>& q, double period);
  /// Call it after each step.
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

/// Returns the initial orbits, the mean and, if there is one, the nearest, for periods of this
/// number of steps. `step` is the time step of the march, s. Their friction is not set.
std::vector<Orbit> firstOrbits(const Passes& passes, double step, int steps);

}  // namespace squeal::cycles
