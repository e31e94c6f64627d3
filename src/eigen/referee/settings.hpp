// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the referee.
#include <string>

#include "eigen/proof/reason.hpp"

namespace squeal::referee {

struct Settings {
  double top = 0;           ///< `-referee_top` in rad/s; 0 = automatic
  double within = 0.08;     ///< the top may move by this fraction, into a gap between eigenvalues
  double left = 0;          ///< `-referee_left`: left edge is Re s = −left · top; 0 = automatic
  double tolerance = 1e-4;  ///< `-referee_tolerance`: largest |δs|/|s| of a right entry
  int discs = 400;          ///< `-referee_discs`: maximum number of discs on the boundary
  proof::Remedies remedies = {};  ///< the options that the reason of a failed proof names

  /// Not collective. Reads the options.
  static Settings given();
};

/// Not collective. Throws Error if one of these options is given; the message says that it needs
/// `needed`. To be called if the option `needed` is not given.
void rejectWithout(const std::string& needed);

}  // namespace squeal::referee
