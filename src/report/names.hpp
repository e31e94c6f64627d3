#pragma once
/// The names of the files of a run, and the files that a version without a manifest left.
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "output/manifest.hpp"
#include "sweep/parameters.hpp"

namespace squeal::report {

/// Returns a point of the sweep as part of file and group names: FRICTION, then _speed_SPEED,
/// _pressure_… for the factors that are not 1.
std::string pointName(const sweep::Parameters& at);

/// The names of the files and folders of a run over some points, relative to the folder of the
/// results.
class ResultNames {
 public:
  explicit ResultNames(const std::vector<sweep::Parameters>& points);
  bool contains(const std::filesystem::path& path) const;

 private:
  bool isField(const std::vector<std::string>& parts) const;
  std::set<std::string> points_;
};

/// The files in `folder` that version 0.1.0, which kept no manifest, left there, the plots of its
/// scripts included; none unless summary.json and options.txt are of that version.
output::Manifest formerResults(const std::filesystem::path& folder);

}  // namespace squeal::report
