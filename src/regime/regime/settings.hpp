// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the motion after the onset of flutter: coefficients of friction, time
/// integration and periodic motions.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "regime/sound/settings.hpp"

namespace squeal::regime {

/// The modes that the time integrations start from: the fastest growing one; each unstable one in
/// turn; or each in turn, and then their sum.
enum class Starts { fastest, each, all };

/// The settings of the time integration.
struct MarchSettings {
  double time = 0;  ///< maximum simulated time, s; 0: until the motion has settled
  double step = 0;  ///< time step, s; 0: automatic
  double startFactor =
      0.5;  ///< initial amplitude relative to the one at which the first node separates or sticks
  Starts starts = Starts::fastest;
  bool massless = true;  ///< the boundary of the reduced model has no mass
};

/// The settings of periodic motions.
struct CycleSettings {
  bool wanted = false;
  int steps = 256;          ///< time steps per period
  double tolerance = 1e-6;  ///< relative change over a period
  /// The range of frictions of the branch; none: the branch is not computed.
  std::optional<std::array<double, 2>> range = {};
  int motions = 20;  ///< largest number of periodic motions on the branch in each direction
};

struct Settings {
  /// The coefficients of friction at which the motion after the onset of flutter is computed,
  /// ascending. The sweep contains them. If empty, no motion is computed, and the other members
  /// have their defaults.
  std::vector<double> frictions;
  MarchSettings march = {};
  CycleSettings cycles = {};
  sound::Settings sound = {};
  bool enabled() const { return !frictions.empty(); }

  /// Returns the settings that the options give. Throws Error for unused options and for options
  /// that exclude each other.
  static Settings given();
};

}  // namespace squeal::regime
