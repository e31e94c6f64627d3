// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Starts MPI, PETSc and SLEPc at the beginning of main() and ends them at its end.
#include <mpi.h>

#include <string>

namespace squeal {

class Session {
 public:
  /// Collective. Starts MPI, PETSc and SLEPc. The options database then contains the options of the
  /// command line, of options files and of the environment, or none with `-help`, `-help_json` or
  /// `-version`. If these options cannot be read, the constructor prints one line and ends the
  /// program with exit code 1.
  Session(int argc, char** argv);
  /// Collective. Ends SLEPc, PETSc and MPI.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  MPI_Comm comm() const;
  int rank() const;
  int size() const;
  /// Returns true if `-help` was given: the program then prints the manual and ends.
  bool helpWanted() const { return helpWanted_; }
  bool helpJsonWanted() const { return helpJsonWanted_; }
  /// Returns the stage given after `-help` or `-help_json`; empty for the whole manual.
  const std::string& helpStage() const { return helpStage_; }
  /// Returns true if `-version` was given.
  bool versionWanted() const { return versionWanted_; }
  /// Returns true if an option is given on the command line, in the environment or in PETSc's
  /// resource files; always false with `-help`, `-help_json` or `-version`.
  bool optionsGiven() const { return optionsGiven_; }

 private:
  std::string helpStage_;
  bool helpWanted_ = false, helpJsonWanted_ = false, versionWanted_ = false, optionsGiven_ = false;
};

/// Returns the version of this program, as in CMakeLists.txt.
const char* version();
/// Returns the versions of this program and of its libraries, one per line. Call it during a
/// session.
std::string versions();
/// Collective. Prints a warning if OpenBLAS uses different code on the ranks, for different
/// processors: ranks whose round-off differs may decide differently, and then wait for each other.
void warnIfBlasDiffers(MPI_Comm comm);

}  // namespace squeal
