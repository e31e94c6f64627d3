// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A variable of a MATLAB file of version 4 or 5.
#include <cstdint>
#include <string>
#include <vector>

#include "problem/matrixfile/formats.hpp"

namespace squeal::matrixfile {

/// A variable as described by its header.
struct Variable {
  std::string name;
  std::string kind;              ///< "double", "complex sparse", "struct": for messages
  bool real = false;             ///< a matrix of real numbers; in version 5 of doubles or singles
  bool sparse = false;           ///< otherwise a full matrix
  std::vector<long long> shape;  ///< one number per dimension
  std::uint64_t begin = 0, end = 0;  ///< first byte in the file, and the byte after the last
  bool swapped = false, packed = false;
  int type = 0;  ///< type of the values in version 4
};

/// Returns the entries of a full matrix from its values, which are given column by column.
Entries full(const Variable& variable, const std::vector<double>& values);

}  // namespace squeal::matrixfile
