#pragma once
/// The readers of MATLAB's versions 4 and 5 share these parts.
#include <string>
#include <vector>

#include "matrixfile/bytes.hpp"
#include "matrixfile/formats.hpp"

namespace squeal::matrixfile {

/// A variable, by its header.
struct Variable {
  std::string name;
  std::string kind;                  ///< "double", "complex sparse", "struct": for messages
  bool real = false;                 ///< a table of real doubles or singles, full or sparse
  bool sparse = false;               ///< full otherwise
  std::vector<long long> shape;      ///< one number per dimension
  std::uint64_t begin = 0, end = 0;  ///< the bytes that hold it
  bool swapped = false, packed = false;
  int type = 0;  ///< of the values in version 4
};

/// All variables in the order of the file. Errors: sizes that do not add up to that of the file;
/// damaged headers.
std::vector<Variable> variablesOfVersion4(BinaryFile& file);
std::vector<Variable> variablesOfVersion5(BinaryFile& file);

/// A variable that is `real` and of two dimensions. Error: damaged content.
Entries readVersion4(BinaryFile& file, const Variable& variable);
Entries readVersion5(BinaryFile& file, const Variable& variable);

/// The entries of a full matrix, by columns.
Entries full(const Variable& variable, const std::vector<double>& values);

}  // namespace squeal::matrixfile
