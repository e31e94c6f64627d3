// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the results outside the contact: the latest periods and the sound.
#include <vector>

#include "base/options/option_types.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::sound {

using mesh::Point;

struct Settings {
  int cyclesKept = 2;                      ///< latest periods whose displacements are stored
  int frames = 16;                         ///< of each of these periods
  double airImpedance = 415;               ///< density times speed of sound, N s/m³
  std::vector<Point> spectrumPoints = {};  ///< m; empty: the node with the largest motion

  /// Returns the number of frames per period, s, that a march with this step, s, allows.
  int framesOfPeriod(double period, double step) const;

  /// Returns the settings that the options give. Throws Error for frames without a stored period,
  /// and for texts that are not points.
  static Settings given();
  /// Returns the options of this room.
  static std::vector<const Option*> options();
};

}  // namespace squeal::sound
