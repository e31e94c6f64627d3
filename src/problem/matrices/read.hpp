// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A matrix from a file, distributed over the ranks.
#include <filesystem>
#include <string>

#include "base/petsc/owned.hpp"

namespace squeal::matrices {

/// Collective. Returns a square matrix from a file of any known format, which is recognised by its
/// content. The matrix has the PETSc type AIJ and is distributed by rows. `dataset` names a
/// variable or object within the file; an empty name means the only matrix there. Rank 0 reads the
/// whole file; only from a file in PETSc's binary format does each rank read its own rows. Throws
/// Error on all ranks, with file and cause, for files that the readers of `matrixfile` reject, for
/// a `dataset` if the format stores a single matrix, for a matrix that is not square or has far
/// more rows than entries, and for entries that are not finite or whose squares overflow.
OwnedMat read(MPI_Comm comm, const std::filesystem::path& path, const std::string& dataset = {});

}  // namespace squeal::matrices
