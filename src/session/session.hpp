#pragma once
/// One session of MPI, PETSc, SLEPc and gmsh for the life of main().
#include <mpi.h>

#include <string>

namespace squeal {

class Session {
 public:
  /// Collective. Starts MPI, PETSc, SLEPc and the gmsh library; the options database holds the
  /// command line and its option files.
  Session(int argc, char** argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  MPI_Comm comm() const;
  int rank() const;
  int size() const;
  /// True if `-help` was given: the manual is wanted, not a run.
  bool helpWanted() const { return helpWanted_; }
  /// True if `-version` was given.
  bool versionWanted() const { return versionWanted_; }
  /// False if there is no option at all, neither on the command line nor in the environment or
  /// PETSc's resource files.
  bool optionsGiven() const { return optionsGiven_; }

 private:
  bool helpWanted_ = false, versionWanted_ = false, optionsGiven_ = false;
};

/// The version of this program, as in CMakeLists.txt.
const char* version();
/// The versions of this program and of what it is linked with, in lines. Within a session.
std::string versions();

}  // namespace squeal
