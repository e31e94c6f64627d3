// SPDX-License-Identifier: BSD-2-Clause
// A file of MATLAB's version 4 consists of consecutive variables, each with a header of five
// integers, its name and its values by columns.
#include "problem/matrixfile/matlab4.hpp"

#include <array>
#include <cinttypes>
#include <cmath>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::matrixfile {
namespace {

constexpr std::size_t headerSize = 20;

/// Returns the bytes per value of a type: double, float, and integers of 32, 16, 16 and 8 bits.
std::uint64_t widthOf(int type) { return std::array<std::uint64_t, 6>{8, 4, 4, 2, 2, 1}.at(type); }

double valueAt(const char* bytes, int type, bool swapped) {
  switch (type) {
    case 0:
      return numberAt<double>(bytes, swapped);
    case 1:
      return numberAt<float>(bytes, swapped);
    case 2:
      return numberAt<std::int32_t>(bytes, swapped);
    case 3:
      return numberAt<std::int16_t>(bytes, swapped);
    case 4:
      return numberAt<std::uint16_t>(bytes, swapped);
    default:
      return numberAt<std::uint8_t>(bytes, swapped);
  }
}

std::vector<double> valuesOf(BinaryFile& file, const Variable& variable) {
  std::vector<char> bytes(variable.end - variable.begin);
  file.seek(variable.begin);
  file.read(bytes.data(), bytes.size());
  const std::size_t width = widthOf(variable.type);
  std::vector<double> values(bytes.size() / width);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = valueAt(bytes.data() + k * width, variable.type, variable.swapped);
  return values;
}

Variable variableAt(BinaryFile& file, std::uint64_t position) {
  file.seek(position);
  if (file.size() - position < headerSize)
    throw Error("the file is truncated in the header of a variable");
  const auto fail = [&] {
    throw Error(formatted("no header of a MATLAB variable at byte %" PRIu64
                          ": the file is damaged, or not a MATLAB file",
                          position));
  };
  char bytes[headerSize];
  file.read(bytes, sizeof bytes);
  Variable variable;
  // The thousands digit is the byte order, 0 for little-endian and 1 for big-endian, so the type
  // reveals its own byte order.
  const auto type = [&](bool swapped) { return numberAt<std::int32_t>(bytes, swapped); };
  variable.swapped =
      type(!littleEndian) / 1000 == 0 && type(!littleEndian) >= 0 ? !littleEndian : littleEndian;
  const auto word = [&](std::size_t i) -> long long {
    return numberAt<std::int32_t>(bytes + 4 * i, variable.swapped);
  };
  const long long mopt = word(0), imaginary = word(3), nameLength = word(4);
  if (mopt / 1000 != (variable.swapped == littleEndian ? 1 : 0) || mopt < 0 ||
      mopt / 100 % 10 != 0 || mopt / 10 % 10 > 5 || mopt % 10 > 2 || word(1) < 0 || word(2) < 0 ||
      imaginary < 0 || imaginary > 1 || nameLength < 1 || nameLength > 4096)
    fail();
  variable.type = mopt / 10 % 10;
  variable.sparse = mopt % 10 == 2;
  variable.shape = {word(1), word(2)};
  variable.begin = position + headerSize + nameLength;
  const std::uint64_t count = word(1) * word(2),  // less than 2^62
      width = widthOf(variable.type) * (1 + imaginary);
  if (variable.begin > file.size() || count > (file.size() - variable.begin) / width)
    throw Error(formatted("the file is truncated: the variable at byte %" PRIu64
                          " is longer than the rest of the file",
                          position));
  variable.end = variable.begin + count * width;
  variable.name.resize(nameLength);
  file.read(variable.name.data(), variable.name.size());
  variable.name = variable.name.c_str();  // it ends with a zero
  const bool isText = mopt % 10 == 1, complex = imaginary == 1 || (variable.sparse && word(2) == 4);
  variable.kind = std::string(complex ? "complex " : "") + (isText            ? "text"
                                                            : variable.sparse ? "sparse"
                                                                              : "double");
  variable.real = !isText && !complex;
  return variable;
}

/// Returns the value as a size or an index. Throws Error unless it is a whole number that is not
/// negative.
long long sizeFrom(double value) {
  if (!(value >= 0 && value < 9e15) || value != std::floor(value))
    throw Error(formatted("a size or an index of %g", value));
  return value;
}

/// Reads the size of a sparse matrix, which is in its last row.
void completeSparse(BinaryFile& file, Variable& variable) {
  const std::size_t rows = variable.shape[0];
  if (!variable.real) return;
  if (rows < 1 || variable.shape[1] != 3)
    throw Error("variable '" + variable.name + "': a sparse matrix without its size");
  const auto width = widthOf(variable.type);
  std::vector<long long> shape;
  for (std::size_t column = 0; column < 2; ++column) {
    char bytes[8];
    file.seek(variable.begin + (column * rows + rows - 1) * width);
    file.read(bytes, width);
    shape.push_back(sizeFrom(valueAt(bytes, variable.type, variable.swapped)));
  }
  variable.shape = shape;
}

}  // namespace

std::vector<Variable> variablesOfVersion4(BinaryFile& file) {
  std::vector<Variable> variables;
  for (std::uint64_t position = 0; position < file.size(); position = variables.back().end) {
    Variable variable = variableAt(file, position);
    if (variable.sparse) completeSparse(file, variable);
    variables.push_back(std::move(variable));
  }
  return variables;
}

Entries readVersion4(BinaryFile& file, const Variable& variable) {
  const auto values = valuesOf(file, variable);
  if (!variable.sparse) return full(variable, values);
  Entries entries(variable.shape[0], variable.shape[1]);
  const std::size_t rows = values.size() / 3;
  for (std::size_t k = 0; k + 1 < rows; ++k)
    entries.add(sizeFrom(values[k]) - 1, sizeFrom(values[rows + k]) - 1, values[2 * rows + k]);
  return entries;
}

}  // namespace squeal::matrixfile
