// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/unreadable.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace squeal {

std::string whyUnreadable(const std::filesystem::path& path) {
  if (faccessat(AT_FDCWD, path.c_str(), R_OK, AT_EACCESS) == 0) return "";
  const int error = errno;
  if (error != ENOENT) return std::string("cannot be read: ") + std::strerror(error);
  std::error_code noLink;
  const auto target = std::filesystem::read_symlink(path, noLink);
  if (noLink) return noSuchFile;
  return "it is a link to '" + target.string() + "': " + std::strerror(error);
}

}  // namespace squeal
