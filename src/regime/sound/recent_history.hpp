// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The recent history of a march, for displacements at its end.
#include <deque>
#include <vector>

#include "base/system/stream.hpp"
#include "regime/march/model.hpp"
#include "regime/march/scheme.hpp"
#include "regime/sound/settings.hpp"

namespace squeal::sound {

using linalg::DenseMatrix;
using march::ReducedModel;
using march::Scheme;

/// The motion at one instant, in the coordinates of the reduced model.
struct Sample {
  double time = 0;            ///< s
  std::vector<double> q, z;   ///< of modes and of static responses
  std::vector<double> gap;    ///< [node], including the steady gap, m
  std::vector<double> force;  ///< R_N, [node], N
};

/// The history of a march, on the rank that computed it.
struct Trace {
  DenseMatrix velocities;       ///< of the modes, samples × modes
  double sampleTime = 0;        ///< interval of these samples, s
  std::vector<Sample> samples;  ///< of the latest cycles
};

/// Not collective. Writes or reads a sample.
void fields(Stream& stream, Sample& sample);

/// Stores the samples of the latest `-regime_cycles_kept` periods.
class RecentHistory {
 public:
  /// `period` is the period of a mode, s, and `step` the time step of the march, s. Borrows the
  /// model.
  RecentHistory(const ReducedModel& model, const Settings& settings, double period, double step);
  void inspect(const Scheme& scheme);
  /// Returns the samples in the order of time. They span a whole number of periods, within a time
  /// step; fewer periods if the march was shorter.
  std::vector<Sample> samples() const;

 private:
  const ReducedModel& model_;
  int frames_;  // of a period
  long most_;
  double interval_, next_;  // between frames, and the time of the next frame, s
  std::deque<march::State> states_;
};

}  // namespace squeal::sound
