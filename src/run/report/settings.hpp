#pragma once
/// The choices of the report.

namespace squeal::report {

/// Options of the report.
struct Settings {
  int modes = 10;  ///< `-report_modes`: number of free modes written as fields
  /// Not collective. Reads the options.
  static Settings given();
};

}  // namespace squeal::report
