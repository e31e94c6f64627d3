// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Runs work that may crash or exhaust the memory in a child process: a function, in a copy of this
/// process, or a program of its own.
///
/// A program has a clean process: none of the libraries, memory, files and signal handlers of an
/// MPI process. Only the program loads the libraries of the work, so this one starts faster. It
/// costs the start of the program.
#include <functional>
#include <string>
#include <vector>

#include "base/system/child_limits.hpp"

namespace squeal {

/// Work whose result is bytes, such as those of a Stream.
using ChildWork = std::function<std::vector<char>(const Warn&)>;

/// Not collective. Runs `work` in a child process and returns its result. The child starts as a
/// copy of this process, and its memory is freed when it exits; `work` must not call MPI. Throws
/// Error if the child cannot be started, crashes or reaches a limit. If `work` throws an exception,
/// throws Error with its message.
std::vector<char> inChild(const ChildLimits& limits, const ChildWork& work);

/// Not collective. Starts the program `name` of this installation as a child process, which
/// receives `job` as an Assignment, and returns its result. Throws Error as inChild() does, and if
/// the program is missing.
std::vector<char> inProgram(const std::string& name, const ChildLimits& limits,
                            const std::vector<char>& job);

}  // namespace squeal
