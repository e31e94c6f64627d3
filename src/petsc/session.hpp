#pragma once
/// One session of MPI, PETSc, SLEPc and gmsh for the life of main().
#include <mpi.h>

namespace squeal {

class Session {
 public:
  /// Collective. Starts MPI, PETSc, SLEPc and the gmsh library; the options database holds the command line and its option files.
  Session(int argc, char** argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  MPI_Comm comm() const;
  int rank() const;
  int size() const;
  /// True if `-help` was given: the manual is wanted, not a run.
  bool helpWanted() const { return helpWanted_; }

 private:
  bool helpWanted_ = false;
};

/// The version of this program, as in CMakeLists.txt.
const char* version();

}  // namespace squeal
