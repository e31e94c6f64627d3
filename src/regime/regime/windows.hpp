// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Averages of a time integration over windows of cycles [M.74].
#include <vector>

#include "regime/march/model.hpp"
#include "regime/march/scheme.hpp"

namespace squeal::regime {

using march::ReducedModel;
using march::Scheme;

/// Averages over a span of time.
struct Means {
  double from = 0, to = 0;         ///< begin and end, s
  double kinetic = 0;              ///< mean kinetic energy, J
  double peakKinetic = 0;          ///< mean of the largest kinetic energies of the cycles, J
  double frictionCoefficient = 0;  ///< −Σ R_T·τ / Σ R_N of the nodes with Node::slides()
  double frictionPower = 0;        ///< −Σ R_T·w, W
  double open = 0, sticking = 0;   ///< mean numbers of open and sticking nodes
  bool linear = true;              ///< no node leaves its steady state: open, sticking or sliding
};

/// Averages of one node over the same span.
struct NodeMeans {
  double open = 0, stick = 0, slip = 0;  ///< fractions of the time in these states
  double pressure = 0;                   ///< mean, Pa
  double largestGap = 0;                 ///< m
  double power = 0;                      ///< heat of friction, W
};

/// The averages of one window.
struct Window {
  Means means;
  std::vector<NodeMeans> nodes;
  double largestVelocity = 0;  ///< of a slip, relative to steady sliding, m/s
  double largestJump = 0;      ///< of a gap, relative to steady sliding, m
};

/// Accumulates the averages of a time integration, window by window.
class WindowRecorder {
 public:
  /// Borrows the model.
  explicit WindowRecorder(const ReducedModel& model);
  /// Call it after each step.
  void inspect(const Scheme& scheme);
  /// Ends a window at this time, s; `peakKinetic` is the mean of the peaks of its cycles, J.
  void end(double time, double peakKinetic);
  /// Returns the complete windows.
  const std::vector<Window>& windows() const { return windows_; }
  /// Returns the mean normal force of the closed nodes in steady sliding, N.
  double meanForce() const { return meanForce_; }

 private:
  void inspectNode(std::size_t i, const Scheme& scheme);

  const ReducedModel& model_;
  double meanForce_ = 0;
  std::vector<Window> windows_;
  Window window_;   // the current window
  long steps_ = 0;  // steps in the current window
  double normalSum_ = 0, alongSum_ = 0;
};

}  // namespace squeal::regime
