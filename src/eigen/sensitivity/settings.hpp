// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the sensitivities.

namespace squeal::sensitivity {

/// Options of the sensitivities.
struct Settings {
  bool wanted = false;  ///< `-flutter_sensitivities`
  /// Not collective. Reads the options.
  static Settings given();
};

}  // namespace squeal::sensitivity
