// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Finds the reason why a file cannot be read.
#include <filesystem>
#include <string>

namespace squeal {

inline constexpr const char* noSuchFile = "there is no such file";

/// Not collective. Returns the reason why this process cannot read the file or list the folder;
/// empty if it can. It does not open the file, since the writer of a pipe would notice that.
std::string whyUnreadable(const std::filesystem::path& path);

}  // namespace squeal
