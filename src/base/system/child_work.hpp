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
  noMemory,   ///< the content is empty
  notStarted  ///< the content is errno, an int
};

void fields(Stream& stream, ChildLimits& limits);

/// Writes an answer to a pipe.
void answer(int pipe, Outcome outcome, const char* bytes, std::size_t count);

/// Gives all signals their default action, except SIGTERM and SIGUSR1, which are ignored from here
/// on: mpirun sends them to the whole process group, but the parent decides how the run stops.
void resetSignals();

/// Redirects the standard input and both outputs of this process to /dev/null. This hides the lines
/// that the C library prints on a crash; the parent reports the crash. Warnings still reach the
/// former error output.
void closeOutputs();

/// Does the work under the limits, writes its outcome to the pipe, and exits without flushing or
/// finalising anything. Call closeOutputs() first.
[[noreturn]] void workAndExit(int pipe, const ChildLimits& limits,
                              const std::function<std::vector<char>(const Warn&)>& work);

/// The job of a program that inProgram() has started. The program receives the job on its standard
/// input and sends the answer to its standard output.
class Assignment {
 public:
  /// The work: takes the bytes of a job and returns those of the result.
  using Work = std::function<std::vector<char>(std::vector<char> job, const Warn&)>;

  /// Reads the job, and closes the standard input and outputs. If inProgram() of this version of
  /// the program has not written the job, reports this and exits. The report is an answer or, if
  /// the standard input is a terminal, a printed line.
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
