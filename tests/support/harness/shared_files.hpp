// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Files in a folder that all ranks see. All functions are collective: nobody writes while others
/// look.
#include <mpi.h>

#include <filesystem>

#include "base/petsc/check.hpp"
#include "support/harness/folder_files.hpp"
#include "support/harness/ranks.hpp"
#include "support/harness/scratch_folder.hpp"

namespace squeal::test::shared {

/// This rank is the one that writes.
inline bool first() { return rankOf() == 0; }

inline Files filesIn(const fs::path& folder) {
  MPI_Barrier(PETSC_COMM_WORLD);
  Files files = test::filesIn(folder);
  MPI_Barrier(PETSC_COMM_WORLD);
  return files;
}

inline bool isThere(const fs::path& path) {
  MPI_Barrier(PETSC_COMM_WORLD);
  const bool found = fs::exists(path);
  MPI_Barrier(PETSC_COMM_WORLD);
  return found;
}

inline void put(const fs::path& folder, const Files& files) {
  if (first()) test::put(folder, files);
  MPI_Barrier(PETSC_COMM_WORLD);
}

}  // namespace squeal::test::shared
