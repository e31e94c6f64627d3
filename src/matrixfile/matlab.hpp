#pragma once
/// Common parts of the readers of MATLAB files of versions 4 and 5.
#include <string>
#include <vector>

#include "matrixfile/bytes.hpp"
#include "matrixfile/formats.hpp"

namespace squeal::matrixfile {

/// A variable, as its header describes it.
struct Variable {
  std::string name;
  std::string kind;                  ///< "double", "complex sparse", "struct": for messages
  bool real = false;                 ///< a table of real doubles or singles, full or sparse
  bool sparse = false;               ///< full otherwise
  std::vector<long long> shape;      ///< one number per dimension
  std::uint64_t begin = 0, end = 0;  ///< the bytes that hold it
  bool swapped = false, packed = false;
  int type = 0;  ///< type of the values in version 4
};

/// These functions return all variables in the order of the file. They throw Error if sizes do not
/// add up to that of the file, and for damaged headers.
std::vector<Variable> variablesOfVersion4(BinaryFile& file);
std::vector<Variable> variablesOfVersion5(BinaryFile& file);

/// These functions read a variable that is `real` and has two dimensions. They throw Error for
/// damaged content.
Entries readVersion4(BinaryFile& file, const Variable& variable);
Entries readVersion5(BinaryFile& file, const Variable& variable);

/// Returns the entries of a full matrix whose values are given by columns.
Entries full(const Variable& variable, const std::vector<double>& values);

}  // namespace squeal::matrixfile
