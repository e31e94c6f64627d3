// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of a file in PETSc's binary format before MatLoad() reads it.
#include <filesystem>

namespace squeal::matrixfile {

/// Throws Error unless the file is one complete, square, real, sparse matrix in PETSc's binary
/// format, with the index size of this build, and with row lengths, columns and values that
/// MatLoad() reads correctly. Only one row is in memory at a time.
void requirePetscBinary(const std::filesystem::path& path);

}  // namespace squeal::matrixfile
