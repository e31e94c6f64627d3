#pragma once
/// Why a file cannot be read.
#include <filesystem>
#include <string>

namespace squeal {

inline constexpr const char* noSuchFile = "there is no such file";

/// Empty if this process may read the file, or list the folder, of this name; else the reason in
/// words. Opens nothing, since whoever writes to a pipe would notice. Not collective.
std::string whyUnreadable(const std::filesystem::path& path);

}  // namespace squeal
