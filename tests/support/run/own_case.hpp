// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A case in a folder of its own, and commands of a shell there. For tests on one rank.
#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/harness/program.hpp"

namespace squeal::test {

/// A folder with a blank in its name, with a case and its mesh in it: "my case.yaml".
inline fs::path ownCase(const std::string& name) {
  const fs::path place = placeFor(name) / "my cases";
  fs::remove_all(placeFor(name));
  fs::create_directories(place);
  for (const char* file : {"layer.geo", "grid.inc"})
    fs::copy_file(fs::path(SQUEAL_SOURCE_DIR) / "meshes" / file, place / file);
  fs::rename(place / "layer.geo", place / "my layer.geo");
  std::string text = contentOf(fs::path(SQUEAL_SOURCE_DIR) / "options/layer.yaml");
  const std::string shipped = "../meshes/layer.geo";
  text.replace(text.find(shipped), shipped.size(), "my layer.geo");
  writeText(place / "my case.yaml", text);
  return place;
}

/// The exit code of a shell command in a folder.
inline int shell(const fs::path& folder, const std::string& command) {
  const int status = std::system(("cd '" + folder.string() + "' && " + command).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/// Options that make the run of the case small.
inline const std::string small =
    " -mesh_set 'nx=6, ny=3' -modes_count 5 -flutter_friction '0, 0.2' -report_fields off";

}  // namespace squeal::test
