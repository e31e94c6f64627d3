// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/installation.hpp"

#include <dlfcn.h>
#include <link.h>

#include <filesystem>
#include <vector>

#include "base/system/error.hpp"

namespace squeal {
namespace {

/// Returns the file that contains this function.
std::filesystem::path ownFile() {
  Dl_info info{};
  link_map* map = nullptr;
  const bool found = dladdr1(reinterpret_cast<const void*>(&installedProgram), &info,
                             reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0;
  const bool isLibrary = found && map && *map->l_name;  // the name of the executable is empty
  std::error_code unknown;
  return isLibrary ? std::filesystem::canonical(map->l_name, unknown)
                   : std::filesystem::read_symlink("/proc/self/exe", unknown);
}

}  // namespace

std::string installedProgram(const std::string& name) {
  const std::filesystem::path folder = ownFile().parent_path();
  std::string places;
  for (const auto& place : {folder, (folder / SQUEAL_INTERNAL_PROGRAMS).lexically_normal()}) {
    std::error_code unreadable;
    if (std::filesystem::exists(place / name, unreadable)) return place / name;
    places += (places.empty() ? "'" : " or '") + place.string() + "'";
  }
  throw Error("the program '" + name + "', which belongs to squeal, is not in " + places +
              ": install squeal completely");
}

}  // namespace squeal
