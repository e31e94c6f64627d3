// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Files in Matrix Market format.
#include <filesystem>

#include "problem/matrixfile/formats.hpp"

namespace squeal::matrixfile {

/// Reads a file in Matrix Market format: coordinate or array; general, symmetric or skew-symmetric;
/// real, integer or pattern (all values 1). Exponents may begin with D. A symmetric or
/// skew-symmetric file must contain only one triangle. Throws Error, with the number of the line,
/// for anything else.
Entries readMatrixMarket(const std::filesystem::path& path);

/// Writes all entries in Matrix Market format. Throws output::WriteError, which names the file, if
/// it cannot be written.
void writeMatrixMarket(const std::filesystem::path& path, const Entries& entries);

}  // namespace squeal::matrixfile
