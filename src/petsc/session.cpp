#include "petsc/session.hpp"

#include <gmsh.h>
#include <slepcsys.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "petsc/check.hpp"

namespace squeal {

namespace {

/// Collective. Ends the program if rank 0 cannot read an options file.
void requireReadable(const char* file) {
  int rank = 0, readable = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) readable = std::ifstream(file).good() && !std::filesystem::is_directory(file);
  MPI_Bcast(&readable, 1, MPI_INT, 0, MPI_COMM_WORLD);
  if (readable) return;
  if (rank == 0) std::fprintf(stderr, "squeal: error: option -options_file %s: there is no such file\n", file);
  MPI_Finalize();
  std::exit(1);
}

}  // namespace

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
  check(MPI_Init(&argc, &argv));  // before PETSc's, so that a missing file is told in one line instead of a traceback
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string(argv[i]) == "-options_file") requireReadable(argv[i + 1]);
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
  MPI_Finalize();
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
