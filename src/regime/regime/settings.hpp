// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the motion after flutter: coefficients of friction, time integration and
/// periodic motions.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "regime/sound/settings.hpp"

namespace squeal::regime {

/// The unstable modes on which time integrations start: the fastest growing one; each of them in
/// turn; or each of them in turn, and then their sum.
enum class Starts { fastest, each, all };

/// The settings of the time integration.
struct MarchSettings {
  double time = 0;           ///< maximum simulated time, s; 0: until the motion has settled
  double step = 0;           ///< time step, s; 0: automatic
  double startFactor = 0.5;  ///< initial amplitude / amplitude of the onset
  Starts starts = Starts::fastest;
  bool massless = true;  ///< the boundary of the reduced model has no mass
};

/// The settings of periodic motions.
struct CycleSettings {
  bool wanted = false;
  int steps = 256;          ///< time steps per period
  double tolerance = 1e-6;  ///< largest relative change over a period
  /// Range of friction in which the branch of periodic motions is followed; none: no branch.
  std::optional<std::array<double, 2>> range = {};
  int motions = 20;  ///< largest number of periodic motions on the branch in each direction
};

struct Settings {
  /// The coefficients of friction at which the motion after flutter is computed, ascending. The
  /// sweep contains them. If the list is empty, no motion is computed, and the other members have
  /// their defaults.
  std::vector<double> frictions;
  MarchSettings march = {};
  CycleSettings cycles = {};
  sound::Settings sound = {};
  bool enabled() const { return !frictions.empty(); }

  /// Returns the settings that the options give. Throws Error for options that would have no
  /// effect, and for options that exclude each other.
  static Settings given();
};

}  // namespace squeal::regime
