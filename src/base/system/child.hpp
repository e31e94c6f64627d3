// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Runs, in a child process, work that may crash or exhaust the memory. The work is either a
/// function, which runs in a copy of this process, or a separate program.
///
/// A separate program runs in a clean process, without the libraries, memory, files and signal
/// handlers of an MPI process. Only that program loads the libraries that the work needs, so the
/// calling program starts faster. The price is the time to start the separate program.
#include <functional>
#include <string>
#include <vector>

#include "base/system/child_limits.hpp"

namespace squeal {

/// Work that returns bytes, such as those of a Stream.
using ChildWork = std::function<std::vector<char>(const Warn&)>;

/// Not collective. Runs `work` in a child process and returns its result. The child starts as a
/// copy of this process, and its memory is freed when it exits; `work` must not call MPI. Throws
/// Error if the child cannot be started, crashes or reaches a limit. Also throws Error, with the
/// message of the exception, if `work` throws one.
std::vector<char> inChild(const ChildLimits& limits, const ChildWork& work);

/// Not collective. Starts the program `name` of this installation as a child process, which
/// receives `job` as an Assignment, and returns its result. Throws Error as inChild() does, and if
/// the program is missing.
std::vector<char> inProgram(const std::string& name, const ChildLimits& limits,
                            const std::vector<char>& job);

}  // namespace squeal
