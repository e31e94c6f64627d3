// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/system/error.hpp"

namespace squeal {
namespace {

const char* kindOf(mode_t mode) {
  switch (mode & S_IFMT) {
    case S_IFLNK:
      return "a link";
    case S_IFDIR:
      return "a folder";
    case S_IFIFO:
      return "a named pipe";
    case S_IFSOCK:
      return "a socket";
    case S_IFREG:
      return "a regular file";
    default:
      return "a device";
  }
}

/// Returns "PATH is KIND, not `wanted`" if the path exists and is of another type.
std::string whyNot(const std::filesystem::path& path, mode_t type, const char* wanted) {
  struct stat found {};
  if (lstat(path.c_str(), &found) != 0 || (found.st_mode & S_IFMT) == type) return "";
  return path.string() + " is " + kindOf(found.st_mode) + ", not " + wanted;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& failure, int error) {
  const std::string why = whyNotRegular(path);
  throw Error(why.empty() ? failure + ": " + std::strerror(error) : why);
}

}  // namespace

std::string whyNotRegular(const std::filesystem::path& path) {
  return whyNot(path, S_IFREG, "a regular file");
}

std::string whyNoFolder(const std::filesystem::path& path) {
  return whyNot(path, S_IFDIR, "a folder");
}

int openRegular(const std::filesystem::path& path, int flags, const std::string& failure) {
  // Opening some devices has side effects, so the kind is checked first. The file is truncated only
  // after all checks.
  if (const std::string why = whyNotRegular(path); !why.empty()) throw Error(why);
  const int file =
      open(path.c_str(), (flags & ~O_TRUNC) | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (file < 0) fail(path, failure, errno);
  struct stat found {};
  std::string why;
  if (fstat(file, &found) != 0)
    why = failure + ": " + std::strerror(errno);
  else if (!S_ISREG(found.st_mode))
    why = path.string() + " is " + kindOf(found.st_mode) + ", not a regular file";
  else if ((flags & O_TRUNC) && found.st_nlink > 1)
    why = path.string() + " is a second name (a hard link) of another file";
  else if ((flags & O_TRUNC) && ftruncate(file, 0) != 0)
    why = failure + ": " + std::strerror(errno);
  if (why.empty()) return file;
  close(file);
  throw Error(why);
}

std::optional<std::string> contentOfRegular(const std::filesystem::path& path) {
  struct stat named {};
  if (lstat(path.c_str(), &named) != 0 && (errno == ENOENT || errno == ENOTDIR)) return {};
  const std::string failure = "cannot read " + path.string();
  const int file = openRegular(path, O_RDONLY, failure);
  std::string content;
  char piece[1 << 16];
  ssize_t count = 0;
  while ((count = read(file, piece, sizeof piece)) > 0 || (count < 0 && errno == EINTR))
    if (count > 0) content.append(piece, count);
  const int error = errno;
  close(file);
  if (count < 0) throw Error(failure + ": " + std::strerror(error));
  return content;
}

}  // namespace squeal
