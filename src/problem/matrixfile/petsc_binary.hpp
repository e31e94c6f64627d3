#pragma once
/// This function checks a file in PETSc's binary format before MatLoad() reads it.
#include <filesystem>

namespace squeal::matrixfile {

/// Throws Error for a file that is not one square real sparse matrix in PETSc's binary format with
/// the indices of this build, that is cut short, or that holds row lengths, columns or values with
/// which MatLoad() would end the program or misread it. Only one row is held in memory at a time.
void requirePetscBinary(const std::filesystem::path& path);

}  // namespace squeal::matrixfile
