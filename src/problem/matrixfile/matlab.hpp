// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A matrix from a MATLAB file of version 4 or 5.
#include <filesystem>
#include <string>

#include "problem/matrixfile/formats.hpp"

namespace squeal::matrixfile {

/// Reads the variable `name`, sparse or full, from a MATLAB file of version 4 or 5 (`save -v4`,
/// `-v6` and `-v7`). An empty name means the only square matrix with more than one row. Throws
/// Error if the file has none or several such matrices, if the matrix is complex, and if the file
/// is damaged, even in the sizes of other variables.
Entries readMatlab(const std::filesystem::path& path, const std::string& name);

}  // namespace squeal::matrixfile
