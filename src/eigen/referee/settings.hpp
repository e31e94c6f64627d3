// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the referee.
#include <string>

namespace squeal::referee {

struct Settings {
  double top = 0;           ///< `-referee_top` in rad/s; 0 = automatic
  double left = 0;          ///< `-referee_left`: left edge as a fraction of the top; 0 = automatic
  double tolerance = 1e-4;  ///< `-referee_tolerance`: accuracy of right entries relative to |s|
  int discs = 400;          ///< `-referee_discs`: largest number of discs on the boundary

  /// Not collective. Reads the options.
  static Settings given();
};

/// Not collective. Throws Error if one of these options is given although the option `needed` is
/// not.
void rejectWithout(const std::string& needed);

}  // namespace squeal::referee
