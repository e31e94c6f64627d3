// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the report.
#include <string>

namespace squeal::report {

struct Settings {
  std::string folder = "results";  ///< `-report_dir`
  bool folderOfCase = false;       ///< an options file names the folder: it may contain any files
  std::string note;                ///< `-report_note`: a remark of the user; empty: none
  bool fields = true;              ///< `-report_fields`: write results.h5 and the VTK files
  int modes = 10;                  ///< `-report_modes`: number of free modes written as fields
  int animated = 1;                ///< `-report_animated`: number of animated modes
  int frames = 16;                 ///< `-report_frames`: number of frames per period
  std::string eventLog;            ///< `-log_json`, which may be in the folder; empty: none
  int pieces = 8;                  ///< `-report_pieces`: largest number of VTK files per field

  /// Not collective. Returns the settings that the options give. -report_animated, -report_frames
  /// and -report_pieces are read only for a mesh whose fields are written, and -report_modes only
  /// with the reduced method.
  static Settings given(bool isReduced, bool ofMesh, const std::string& eventLog);
};

}  // namespace squeal::report
