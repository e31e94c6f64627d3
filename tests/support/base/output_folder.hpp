// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A folder of results, as a run replaces it.
#include <filesystem>

#include "base/output/folder.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/harness/shared_files.hpp"

namespace squeal::test {

/// Collective. Replaces the results in a folder by these. All ranks have left it at the end.
inline void replace(const output::Naming& naming, const std::filesystem::path& folder,
                    const Files& results) {
  {
    output::Folder open(PETSC_COMM_WORLD, naming, folder);
    open.stage();
    shared::put(open.staging(), results);
    open.commit();
  }
  MPI_Barrier(PETSC_COMM_WORLD);
}

}  // namespace squeal::test
