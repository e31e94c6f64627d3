#pragma once
/// A child process for work that may crash or need more memory than there is.
#include <functional>
#include <optional>
#include <string>

#include "petsc/buffer.hpp"

namespace squeal {

/// Prints a warning at once, on the standard error output.
using Warn = std::function<void(const std::string&)>;

struct ChildLimits {
  std::string subject;                     ///< begins every message
  std::optional<double> processorSeconds;  ///< limit of processor time, s; none: no limit
  double memoryBytes = 0;                  ///< address space that the work may allocate, bytes
  std::string noMemory;                    ///< message if that is too little
  std::string program;                     ///< the library that works, for messages: "gmsh"
};

/// Runs `work` in a child process and returns its result. The child inherits a copy of this
/// process, and its memory is freed when it ends; `work` must not call MPI. Throws Error if `work`
/// throws, if the child crashes, or if it reaches a limit. Not collective.
Buffer inChild(const ChildLimits& limits, const std::function<Buffer(const Warn&)>& work);

}  // namespace squeal
