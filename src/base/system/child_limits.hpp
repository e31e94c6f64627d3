// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The limits of a child process (see child.hpp).
#include <functional>
#include <optional>
#include <string>

namespace squeal {

/// Prints a warning at once, on the standard error output.
using Warn = std::function<void(const std::string&)>;

/// The limits of a child process, and texts for messages about the process.
struct ChildLimits {
  std::string subject;  ///< beginning of all messages except those that the work throws
  std::optional<double> processorSeconds;  ///< limit of processor time, s; none = no limit
  double memoryBytes = 0;                  ///< address space that the work may allocate, bytes
  std::string noMemory;                    ///< message if `memoryBytes` is too little
  std::string program;                     ///< library that does the work, for messages: "gmsh"
};

}  // namespace squeal
