// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of tracking and of the search for critical frictions.
#include "eigen/pencil/settings.hpp"

namespace squeal::stability {

/// Options of tracking.
struct Settings {
  bool track = true;        ///< `-flutter_track`
  bool requested = false;   ///< requested explicitly: `-flutter_track` is given, or
                            ///< `-flutter_critical` is given and on
  bool critical = true;     ///< `-flutter_critical`
  double tolerance = 1e-8;  ///< `-flutter_critical_tolerance`: relative to the friction
  /// Smallest step as a fraction of a step of the sweep: 2^-h for h = `-flutter_track_halvings`.
  double smallest = 1. / 1024;
  /// Not collective. Reads the options; those of the reduced method only if it is selected.
  static Settings given(const pencil::Settings& problem);
};

}  // namespace squeal::stability
