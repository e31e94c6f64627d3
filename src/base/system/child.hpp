#pragma once
/// This file starts a child process for work that may crash or need more memory than there is.
#include <functional>
#include <optional>
#include <string>

#include "base/system/buffer.hpp"

namespace squeal {

/// A Warn prints a warning at once, on the standard error output.
using Warn = std::function<void(const std::string&)>;

/// The limits of a child process, and the words of the messages about it.
struct ChildLimits {
  std::string subject;  ///< begins the messages, but not those that `work` throws
  std::optional<double> processorSeconds;  ///< limit of processor time, s, if there is one
  double memoryBytes = 0;                  ///< address space that the work may allocate, bytes
  std::string noMemory;                    ///< message if that is too little
  std::string program;                     ///< the library that works, for messages: "gmsh"
};

/// Not collective. Runs `work` in a child process and returns its result. The child inherits a copy
/// of this process, and its memory is freed when it ends; `work` must not call MPI. Throws Error if
/// the child cannot be started, crashes or reaches a limit, and with the message of what `work`
/// throws.
Buffer inChild(const ChildLimits& limits, const std::function<Buffer(const Warn&)>& work);

}  // namespace squeal
