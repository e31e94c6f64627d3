// SPDX-License-Identifier: BSD-2-Clause
#include "base/output/file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/petsc/check.hpp"
#include "base/system/regular_file.hpp"
#include "base/system/termination.hpp"

namespace squeal::output {

std::string cannotWrite(const std::filesystem::path& path, int error) {
  return "cannot write " + path.string() + (error ? std::string(": ") + std::strerror(error) : "");
}

int openToWrite(const std::filesystem::path& path, int flags) {
  try {
    return openRegular(path, flags | O_CREAT | O_TRUNC, cannotWrite(path, 0));
  } catch (const Error& error) {
    throw WriteError(error.what());
  }
}

void writeFile(const std::filesystem::path& path, const std::string& text) {
  const SignalsBlocked whole;
  const int descriptor = openToWrite(path);
  std::FILE* file = fdopen(descriptor, "wb");
  if (!file) {
    const int error = errno;
    close(descriptor);
    throw WriteError(cannotWrite(path, error));
  }
  int error =
      std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0
          ? 0
          : errno;
  if (std::fclose(file) != 0 && error == 0) error = errno;
  if (error != 0) throw WriteError(cannotWrite(path, error));
}

void reserve(const std::filesystem::path& path, unsigned long long bytes) {
  const SignalsBlocked whole;
  rlimit most{};
  const int file = openToWrite(path);
  int error = getrlimit(RLIMIT_FSIZE, &most) == 0 && bytes > most.rlim_cur ? EFBIG : 0;
  if (error == 0 && bytes > 0 && fallocate(file, FALLOC_FL_KEEP_SIZE, 0, bytes) != 0) error = errno;
  close(file);
  // Some file systems, such as NFS, cannot reserve space: a full disk then shows up in the write.
  if (error != 0 && error != EOPNOTSUPP) throw WriteError(cannotWrite(path, error));
}

void sync(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) throw WriteError(cannotWrite(path, errno));
  const int error = fsync(file) == 0 ? 0 : errno;
  close(file);
  // Some file systems do not support fsync of a folder.
  if (error != 0 && error != EINVAL) throw WriteError(cannotWrite(path, error));
}

}  // namespace squeal::output
