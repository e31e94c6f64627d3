// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of checkpoints.

namespace squeal::checkpoint {

struct Settings {
  bool enabled = true;   ///< `-checkpoint`
  double interval = 60;  ///< `-checkpoint_interval`: minimum wall time between entries, s
  bool resume = false;   ///< `-resume`

  /// Not collective. Reads the options.
  static Settings given();
};

}  // namespace squeal::checkpoint
