#pragma once
/// Work that may crash or ask for more memory than there is, in a process of its own.
#include <functional>
#include <optional>
#include <string>

#include "petsc/buffer.hpp"

namespace squeal {

/// Tells the user at once, on the standard error output.
using Warn = std::function<void(const std::string&)>;

struct ChildLimits {
  std::string subject;                     ///< what the work is about: every message begins with it
  std::optional<double> processorSeconds;  ///< none: as long as it takes
  double memoryBytes = 0;                  ///< addresses that the work may ask for
  std::string noMemory;                    ///< what it means if that is too little
  std::string program;                     ///< who works, for messages: "gmsh"
};

/// What `work` returns, from a child process: a crash there is an Error here, and its memory goes
/// with it. The child inherits all that this process holds; `work` must not call MPI. Errors: what
/// `work` throws, a crash, a limit reached. Not collective.
Buffer inChild(const ChildLimits& limits, const std::function<Buffer(const Warn&)>& work);

}  // namespace squeal
