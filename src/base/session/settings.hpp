// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the output on the terminal and of the event log.
#include <string>

namespace squeal {

struct OutputSettings {
  bool quiet = false;             ///< `-quiet`: no output except warnings and errors
  std::string eventLog;           ///< `-log_json`: file to append to; empty = none
  std::string progress = "auto";  ///< `-progress`: auto, line or plain

  /// Not collective. Reads the options.
  static OutputSettings given();
};

}  // namespace squeal
