// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The part of child.hpp that runs in the child process. It calls neither MPI nor PETSc.
#include <functional>
#include <vector>

#include "base/system/child_limits.hpp"
#include "base/system/stream.hpp"

namespace squeal {

/// The first byte of an answer. The length of the content follows, and then the content itself.
enum class Outcome : char {
  result,
  failure,    ///< the content is the message of an exception
  noMemory,   ///< empty
  notStarted  ///< the content is errno, an int
};

void fields(Stream& stream, ChildLimits& limits);

/// Writes an answer to a pipe.
void answer(int pipe, Outcome outcome, const char* bytes, std::size_t count);

/// Gives all signals their default action, except SIGTERM and SIGUSR1, which are ignored from here
/// on: mpirun sends them to the whole process group, but the parent decides how the run stops.
void resetSignals();

/// Redirects the standard input and both outputs of this process to /dev/null. This hides the lines
/// that the C library prints on a crash, which the parent reports itself. Warnings still reach the
/// former error output.
void closeOutputs();

/// Does the work under the limits, writes its outcome to the pipe, and exits. It does not flush or
/// finalise anything. Call closeOutputs() before.
[[noreturn]] void workAndExit(int pipe, const ChildLimits& limits,
                              const std::function<std::vector<char>(const Warn&)>& work);

/// The job of a program that inProgram() has started. The program receives the job on its standard
/// input and sends the answer to its standard output.
class Assignment {
 public:
  /// The work, a function of the bytes of a job.
  using Work = std::function<std::vector<char>(std::vector<char> job, const Warn&)>;

  /// Reads the job, and closes the standard input and outputs. Prints a line and exits unless
  /// inProgram() of this version of the program has written the job.
  Assignment();
  /// Does the work within the limits that came with the job, and exits.
  [[noreturn]] void perform(const Work& work);

  /// Returns a job as bytes that the constructor understands.
  static std::vector<char> bytes(ChildLimits limits, std::vector<char> job);

 private:
  int pipe_;
  ChildLimits limits_;
  std::vector<char> job_;
};

}  // namespace squeal
