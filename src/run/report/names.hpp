// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The names of the files of a run.
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/output/manifest.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::report {

/// The option for the results folder.
inline constexpr char folderOption[] = "-report_dir";

/// Returns the name of a point of the sweep, as it appears in the names of files and groups:
/// FRICTION, followed by _speed_SPEED, _pressure_… for the factors that are not 1.
std::string pointName(const sweep::Parameters& at);

/// The names of the files and folders that a run over some points may write, relative to the
/// results folder.
class ResultNames {
 public:
  /// Stores the names of these points, and of their steady states.
  explicit ResultNames(const std::vector<sweep::Parameters>& points);
  /// Returns true if a run over these points may write this path, a file or a folder.
  bool contains(const std::filesystem::path& path) const;

 private:
  bool isField(const std::vector<std::string>& parts) const;
  std::set<std::string> points_;
};

}  // namespace squeal::report
