// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of a file in PETSc's binary format before MatLoad() reads it.
#include <filesystem>

namespace squeal::matrixfile {

/// Throws Error for a file that is not one square real sparse matrix in PETSc's binary format with
/// the indices of this build, that is truncated, or whose row lengths, columns or values MatLoad()
/// would misread or crash on. Only one row is in memory at a time.
void requirePetscBinary(const std::filesystem::path& path);

}  // namespace squeal::matrixfile
