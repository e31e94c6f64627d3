// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The parameters that a run sweeps.
#include <vector>

namespace squeal::sweep {

/// Options of the sweep. Each list is ascending and without duplicates.
struct Settings {
  std::vector<double> frictions{0.4};  ///< `-flutter_friction`
  std::vector<double> speeds{1};       ///< `-flutter_speed`: factors on all velocities
  std::vector<double> pressures{1};    ///< `-flutter_pressure`: factors p (Parameters::pressure)
  std::vector<double> dampings{1};     ///< `-flutter_damping`: factors on the damping
  /// Not collective. Reads the options. Throws Error if a list is empty, or if a value is given
  /// twice or outside its range.
  static Settings given();
};

}  // namespace squeal::sweep
