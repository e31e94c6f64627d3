// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the results outside the contact: displacements of the latest periods, and sound.
#include <vector>

#include "base/options/option_types.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::sound {

using mesh::Point;

struct Settings {
  int cyclesKept = 2;         ///< number of latest periods whose displacements are stored
  int frames = 16;            ///< number of frames of each of these periods
  double airImpedance = 415;  ///< density times speed of sound, N s/m³
  std::vector<Point> spectrumPoints = {};  ///< m; empty: the node with the largest motion

  /// Returns the number of frames per `period`, s: `frames`, but at most one per time `step`, s.
  int framesOfPeriod(double period, double step) const;

  /// Returns the settings that the options give. Throws Error if a number of frames is given but no
  /// period is stored, and for a text that is not a list of points.
  static Settings given();
  /// Returns the options of these settings.
  static std::vector<const Option*> options();
};

}  // namespace squeal::sound
