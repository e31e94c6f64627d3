// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Folders and files that a test writes and all ranks see.
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "base/petsc/check.hpp"
#include "support/harness/ranks.hpp"

namespace squeal::test {

namespace fs = std::filesystem;

/// A fresh folder that all ranks share, removed at the end of the test.
class Folder {
 public:
  Folder() {
    int id = static_cast<int>(getpid());
    MPI_Bcast(&id, 1, MPI_INT, 0, PETSC_COMM_WORLD);
    path = fs::temp_directory_path() / ("squeal_test_" + std::to_string(id));
    if (rankOf(PETSC_COMM_WORLD) == 0) fs::create_directories(path);
    MPI_Barrier(PETSC_COMM_WORLD);
  }
  ~Folder() {
    MPI_Barrier(PETSC_COMM_WORLD);
    if (rankOf(PETSC_COMM_WORLD) == 0) fs::remove_all(path);
  }
  fs::path path;
};

/// Collective. Puts a link to a foreign file, a named pipe, or a folder where a file is to be
/// written; `foreign` holds its own name.
inline void plant(const std::string& kind, const fs::path& path, const fs::path& foreign) {
  if (rankOf(PETSC_COMM_WORLD) == 0) {
    std::ofstream(foreign) << foreign.filename().string();
    if (kind == "a link")
      fs::create_symlink(foreign, path);
    else if (kind == "a named pipe" && mkfifo(path.c_str(), 0666) != 0)
      throw std::runtime_error("cannot make " + path.string());
    else if (kind == "a folder")
      fs::create_directory(path);
  }
  MPI_Barrier(PETSC_COMM_WORLD);
}

/// Collective. A file of the test, written by one rank before any reads it.
inline std::string writeFile(const std::string& name, const std::string& text) {
  const std::string path = SQUEAL_OUTPUT_DIR "/" + name;
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) std::ofstream(path) << text;
  check(MPI_Barrier(PETSC_COMM_WORLD));
  return path;
}

}  // namespace squeal::test
