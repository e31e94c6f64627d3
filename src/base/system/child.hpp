// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Runs work that may crash or exhaust the memory in a child process.
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace squeal {

/// Prints a warning at once, on the standard error output.
using Warn = std::function<void(const std::string&)>;

/// The limits of a child process, and words for the messages about it.
struct ChildLimits {
  std::string subject;  ///< start of the messages, except those that `work` throws
  std::optional<double> processorSeconds;  ///< limit of processor time, s; none = no limit
  double memoryBytes = 0;                  ///< address space that the work may allocate, bytes
  std::string noMemory;                    ///< message if `memoryBytes` is too little
  std::string program;                     ///< library that does the work, for messages: "gmsh"
};

/// Work whose result is bytes, such as those of a Stream.
using ChildWork = std::function<std::vector<char>(const Warn&)>;

/// Not collective. Runs `work` in a child process and returns its result. The child starts as a
/// copy of this process, and its memory is freed when it exits; `work` must not call MPI. Throws
/// Error if the child cannot be started, crashes or reaches a limit. If `work` throws an exception,
/// throws Error with its message.
std::vector<char> inChild(const ChildLimits& limits, const ChildWork& work);

}  // namespace squeal
