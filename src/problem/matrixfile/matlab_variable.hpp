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
  std::string kind;                  ///< "double", "complex sparse", "struct": for messages
  bool real = false;                 ///< a table of real numbers, in version 5 doubles or singles
  bool sparse = false;               ///< full otherwise
  std::vector<long long> shape;      ///< one number per dimension
  std::uint64_t begin = 0, end = 0;  ///< its bytes in the file
  bool swapped = false, packed = false;
  int type = 0;  ///< type of the values in version 4
};

/// Returns the entries of a full matrix whose values are given by columns.
Entries full(const Variable& variable, const std::vector<double>& values);

}  // namespace squeal::matrixfile
