// SPDX-License-Identifier: BSD-2-Clause
#include "base/session/session.hpp"

#include <dmumps_c.h>
#include <gmsh.h>  // only its version: the program squeal_gmsh calls it
#include <hdf5.h>
#include <slepcsys.h>
#include <vtkVersionMacros.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/options/settings.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/log_events.hpp"
#include "base/session/stages.hpp"
#include "base/system/blas_kernel.hpp"
#include "base/system/process_memory.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"

namespace squeal {

namespace {

/// Collective. Returns the options of the call on all ranks. On an error, prints one line and ends
/// the program.
std::vector<Setting> readSettings(const std::vector<std::string>& words) {
  std::vector<Setting> settings;
  try {
    onFirstRank(MPI_COMM_WORLD, "", [&] { settings = settingsOfCall(words); });
    return onAllRanks(MPI_COMM_WORLD, settings);
  } catch (const Error& error) {
    if (mpi::rank(MPI_COMM_WORLD) == 0)
      std::fprintf(stderr, "squeal: error: %s\n", escaped(error.what()).c_str());
    MPI_Finalize();
    std::exit(1);
  }
}

/// Collective. Starts SLEPc and PETSc with all options, since PETSc reads some of them when it
/// starts. Does not pass values that look like names; insert() sets them afterwards.
void startSlepc(char* program, const std::vector<Setting>& settings) {
  static std::vector<std::string> words;  // PETSc stores pointers to them
  static std::vector<char*> pointers;
  words = {program, "-skip_petscrc"};  // already read, like the variables
  unsetenv("PETSC_OPTIONS");
  unsetenv("PETSC_OPTIONS_YAML");
  for (const auto& setting : settings) {
    words.push_back("-" + setting.name);
    if (!setting.value.empty() && setting.value[0] != '-') words.push_back(setting.value);
  }
  for (auto& word : words) pointers.push_back(word.data());
  int count = pointers.size();
  pointers.push_back(nullptr);
  char** arguments = pointers.data();
  if (SlepcInitialize(&count, &arguments, nullptr, nullptr) != 0) MPI_Abort(MPI_COMM_WORLD, 70);
  check(PetscOptionsClearValue(nullptr, "-skip_petscrc"));
  registerWork();
  insert(settings);
}

}  // namespace

Session::Session(int argc, char** argv) {
  SignalWatch signals;
  // The manual of this program replaces PETSc's own -help, which lists several hundred options of
  // its components.
  const std::vector<std::string> words(argv + 1, argv + argc);
  const auto among = [&](const std::vector<std::string>& names) {
    return std::find_first_of(words.begin(), words.end(), names.begin(), names.end()) !=
           words.end();
  };
  helpWanted_ = among({"-help", "--help", "-h"});
  helpJsonWanted_ = among({"-help_json", "--help_json"});
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    for (const char* help : {"-help", "--help", "-h", "-help_json", "--help_json"})
      if (words[i] == help && !words[i + 1].starts_with('-')) helpStage_ = words[i + 1];
  versionWanted_ = among({"-version", "--version"});
  // MPI starts before PETSc: an error in the options is then one line instead of a traceback.
  check(MPI_Init(&argc, &argv));
  const auto settings = helpWanted_ || helpJsonWanted_ || versionWanted_ ? std::vector<Setting>{}
                                                                         : readSettings(words);
  optionsGiven_ = !settings.empty();
  startSlepc(argv[0], settings);
  reportLackOfMemoryInOneLine();
  signals.begin(rank());
  retainFreedMemory();
  allocateBlasWorkspace();
}

Session::~Session() {
  // rejectUnknownOptions() reports them before the run instead of after it.
  PetscOptionsSetValue(nullptr, "-options_left", "no");
  SlepcFinalize();
  MPI_Finalize();
}

MPI_Comm Session::comm() const { return PETSC_COMM_WORLD; }

int Session::rank() const { return mpi::rank(comm()); }

int Session::size() const { return mpi::size(comm()); }

const char* version() { return SQUEAL_VERSION; }

std::string versions() {
  char petsc[256] = "", slepc[256] = "", mpi[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  unsigned hdf5[3] = {};
  check(PetscGetVersion(petsc, sizeof petsc));
  check(SlepcGetVersion(slepc, sizeof slepc));
  check(MPI_Get_library_version(mpi, &length));
  H5get_libversion(&hdf5[0], &hdf5[1], &hdf5[2]);
  const auto firstPart = [](const std::string& text) {
    return text.substr(0, text.find_first_of(",\n"));
  };
  const std::string kernel = blasKernel();
  return formatted(
      "squeal %s\n%s\n%s\nMUMPS %s\n%s\nHDF5 %u.%u.%u, gmsh %s, VTK %s\n%sscalars: %s, %zu bits; "
      "indices: %zu bits\n",
      version(), firstPart(petsc).c_str(), firstPart(slepc).c_str(), MUMPS_VERSION,
      firstPart(mpi).c_str(), hdf5[0], hdf5[1], hdf5[2], GMSH_API_VERSION, VTK_VERSION,
      kernel.empty() ? "" : ("OpenBLAS with the code for " + kernel + "\n").c_str(),
      PetscDefined(USE_COMPLEX) ? "complex" : "real", 8 * sizeof(PetscReal), 8 * sizeof(PetscInt));
}

void warnIfBlasDiffers(MPI_Comm comm) {
  const std::string own = blasKernel();
  std::string first = own;
  mpi::broadcast(comm, first);
  const int ranks = mpi::size(comm), odd = mpi::min(comm, own == first ? ranks : mpi::rank(comm));
  if (odd == ranks) return;
  std::string other = own;
  mpi::broadcast(comm, other, odd);
  printWarning(comm, formatted("OpenBLAS uses the code for %s on rank 0, but that for %s on rank "
                               "%d; their round-off differs, and ranks that decide differently "
                               "hang; set OPENBLAS_CORETYPE for all ranks to the name of one that "
                               "all processors can run (Haswell: those since 2013)",
                               first.c_str(), other.c_str(), odd));
}

}  // namespace squeal
