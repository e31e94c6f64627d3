// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The recent history of a time integration, from which the displacements of the latest cycles are
/// computed.
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
  std::vector<double> q, z;   ///< coordinates of the modes and of the static responses
  std::vector<double> gap;    ///< [node], including the steady gap, m
  std::vector<double> force;  ///< R_N, [node], N
};

/// The history of a time integration. Only the rank that computed it has the content.
struct Trace {
  DenseMatrix velocities;       ///< modal velocities, samples × modes
  double sampleTime = 0;        ///< time between these samples, s
  std::vector<Sample> samples;  ///< of the latest cycles
};

/// Not collective. Writes or reads a sample.
void fields(Stream& stream, Sample& sample);

/// Stores the samples of the latest `-regime_cycles_kept` periods.
class RecentHistory {
 public:
  /// `period` is the period of the mode, s, and `step` the time step, s. Borrows the model.
  RecentHistory(const ReducedModel& model, const Settings& settings, double period, double step);
  void inspect(const Scheme& scheme);
  /// Returns the samples in chronological order. They span a whole number of periods to within a
  /// time step. There are fewer periods if the time integration was too short.
  std::vector<Sample> samples() const;

 private:
  const ReducedModel& model_;
  int frames_;  // number per period
  long most_;
  double interval_, next_;  // time between frames, and time of the next frame, s
  std::deque<march::State> states_;
};

}  // namespace squeal::sound
