#pragma once
/// This object holds the session of MPI, PETSc, SLEPc and gmsh during main().
#include <mpi.h>

#include <string>

namespace squeal {

class Session {
 public:
  /// Collective. Starts MPI, PETSc, SLEPc and the gmsh library. The options database then holds the
  /// options of the call: those of the command line, of options files and of the environment, or
  /// none with `-help` and `-version`. If they cannot be read, the constructor says so in one line
  /// and ends the program with exit code 1.
  Session(int argc, char** argv);
  /// Collective. Ends gmsh, SLEPc, PETSc and MPI.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  MPI_Comm comm() const;
  int rank() const;
  int size() const;
  /// Returns true if `-help` was given: the manual is printed, and there is no run.
  bool helpWanted() const { return helpWanted_; }
  bool helpJsonWanted() const { return helpJsonWanted_; }
  /// Returns the word after -help, which names a stage; empty for the whole manual.
  const std::string& helpStage() const { return helpStage_; }
  /// Returns true if `-version` was given.
  bool versionWanted() const { return versionWanted_; }
  /// Returns false if there is no option at all, neither on the command line nor in the environment
  /// nor in PETSc's resource files, and always with `-help` or `-version`.
  bool optionsGiven() const { return optionsGiven_; }

 private:
  std::string helpStage_;
  bool helpWanted_ = false, helpJsonWanted_ = false, versionWanted_ = false, optionsGiven_ = false;
};

/// Returns the version of this program, as in CMakeLists.txt.
const char* version();
/// Returns the versions of this program and of its libraries, one per line. Call it within a
/// session.
std::string versions();

}  // namespace squeal
