// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Files in Matrix Market format.
#include <filesystem>

#include "problem/matrixfile/formats.hpp"

namespace squeal::matrixfile {

/// Reads Matrix Market: coordinate or array; general, symmetric or skew-symmetric; real, integer or
/// pattern (ones). Exponents may begin with D. A symmetric or skew-symmetric file contains one
/// triangle. Throws Error, with the number of the line, for anything else.
Entries readMatrixMarket(const std::filesystem::path& path);

/// Writes all entries as Matrix Market. Throws output::WriteError, which names the file, if it
/// cannot be written.
void writeMatrixMarket(const std::filesystem::path& path, const Entries& entries);

}  // namespace squeal::matrixfile
