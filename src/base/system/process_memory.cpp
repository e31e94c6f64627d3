// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/process_memory.hpp"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace squeal {
namespace {

/// Returns the first number in a file of /proc or /sys; none if the file does not exist or contains
/// "max".
std::optional<double> numberIn(const std::string& path) {
  double value = 0;
  if (std::ifstream file(path); file >> value) return value;
  return {};
}

/// Returns the number after `name` in a table of /proc or /sys; none if the table has no such line.
std::optional<double> entryOf(const std::string& path, const std::string& name) {
  std::ifstream file(path);
  for (std::string line, word; std::getline(file, line);)
    if (double value = 0; std::istringstream(line) >> word >> value && word == name) return value;
  return {};
}

}  // namespace

double addressSpace() {
  // The first number in the file is the number of all pages.
  return numberIn("/proc/self/statm").value_or(0) * sysconf(_SC_PAGESIZE);
}

double availableMemory() {
  double bytes = 1024 * entryOf("/proc/meminfo", "MemAvailable:").value_or(1e15);
  // A batch job may have its own limit, by control groups of version 2 or 1. The kernel releases
  // the memory of cached files on demand.
  struct Group {
    const char *most, *used, *details, *cached;
  };
  for (const auto& [most, used, details, cached] :
       {Group{"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current",
              "/sys/fs/cgroup/memory.stat", "file"},
        Group{"/sys/fs/cgroup/memory/memory.limit_in_bytes",
              "/sys/fs/cgroup/memory/memory.usage_in_bytes", "/sys/fs/cgroup/memory/memory.stat",
              "cache"}})
    if (const auto all = numberIn(most), now = numberIn(used); all && now)
      bytes = std::min(bytes, std::max(0.0, *all - *now + entryOf(details, cached).value_or(0)));
  return bytes;
}

void retainFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);  // a block from mmap() returns to the kernel when it is freed
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
}

void releaseFreedMemory() {
#ifdef __GLIBC__
#if __GLIBC_PREREQ(2, 33)
  constexpr std::size_t much = 512 << 20;
  if (mallinfo2().fordblks > much) malloc_trim(0);
#endif
#endif
}

}  // namespace squeal
