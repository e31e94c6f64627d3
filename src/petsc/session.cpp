#include "petsc/session.hpp"

#include <gmsh.h>
#include <slepcsys.h>

#include <string>
#include <vector>

#include "petsc/check.hpp"

namespace squeal {

Session::Session(int argc, char** argv) {
  // PETSc's own -help lists several hundred options of its parts; ours is the manual of this program and replaces it.
  std::vector<char*> kept;
  for (int i = 0; i < argc; ++i) {
    const std::string word = argv[i];
    if (i > 0 && (word == "-help" || word == "--help" || word == "-h"))
      helpWanted_ = true;
    else
      kept.push_back(argv[i]);
  }
  int count = static_cast<int>(kept.size());
  kept.push_back(nullptr);
  char** arguments = kept.data();
  if (SlepcInitialize(&count, &arguments, nullptr, nullptr) != 0) MPI_Abort(MPI_COMM_WORLD, 70);
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);  // messages reach the user through our errors
}

Session::~Session() {
  PetscOptionsSetValue(nullptr, "-options_left", "no");  // rejectUnknownOptions says it before the run, not after
  gmsh::finalize();
  SlepcFinalize();
}

MPI_Comm Session::comm() const { return PETSC_COMM_WORLD; }

int Session::rank() const {
  int rank = 0;
  check(MPI_Comm_rank(comm(), &rank));
  return rank;
}

int Session::size() const {
  int size = 1;
  check(MPI_Comm_size(comm(), &size));
  return size;
}

const char* version() { return SQUEAL_VERSION; }

}  // namespace squeal
