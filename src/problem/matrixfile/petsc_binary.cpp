// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrixfile/petsc_binary.hpp"

#include <petscmat.h>

#include <cinttypes>
#include <cmath>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "problem/matrixfile/bytes.hpp"
#include "problem/matrixfile/formats.hpp"

namespace squeal::matrixfile {
namespace {

constexpr bool swapped = littleEndian;  // the format is big-endian

/// PETSc writes integers of its own size, and MatLoad() reads only these.
using Index = PetscInt;
constexpr long long indexBytes = sizeof(Index);

/// The numbers at the beginning of a file: class, rows, columns and entries. The length of each
/// row, the columns row by row, and the values follow without gaps.
struct Header {
  long long rows = 0, columns = 0, entries = 0;
  std::uint64_t columnsBegin() const { return indexBytes * (4 + rows); }
  std::uint64_t valuesBegin() const { return indexBytes * (4 + rows + entries); }
  std::uint64_t end() const { return valuesBegin() + 8 * entries; }
};

Header headerOf(BinaryFile& file) {
  if (file.size() < 4 * indexBytes || file.number<Index>(swapped) != MAT_FILE_CLASSID)
    throw Error("not a matrix in PETSc's binary format: the file is truncated");
  Header header;
  for (auto* value : {&header.rows, &header.columns, &header.entries})
    *value = file.number<Index>(swapped);
  if (header.entries == -1)
    throw Error("a dense matrix in PETSc's binary format; write a sparse one");
  if (header.rows < 0 || header.columns < 0 || header.entries < 0)
    throw Error(formatted("the header announces %lld rows, %lld columns and %lld entries",
                          header.rows, header.columns, header.entries));
  return header;
}

/// Checks that the row lengths sum to the number of entries, and that the columns of each row are
/// valid and distinct: MatLoad() would use the last of two entries in one column.
void checkPattern(const std::filesystem::path& path, const Header& header) {
  BinaryFile lengths(path), columns(path);
  lengths.seek(4 * indexBytes);
  columns.seek(header.columnsBegin());
  long long left = header.entries;
  std::vector<Index> list;
  for (long long row = 0; row < header.rows; ++row) {
    const auto count = lengths.number<Index>(swapped);
    const auto fail = [&](const std::string& why) {
      throw Error(formatted("row %lld (counted from 0) ", row) + why);
    };
    if (count < 0 || count > header.columns)
      fail(formatted("has %" PetscInt_FMT " entries in %lld columns", count, header.columns));
    if (count > left)
      fail(formatted("has more entries than the header announces in all, %lld", header.entries));
    left -= count;
    list.resize(count);
    columns.read(reinterpret_cast<char*>(list.data()), list.size() * sizeof list[0]);
    for (auto& column : list) {
      column = numberAt<Index>(reinterpret_cast<const char*>(&column), swapped);
      if (column < 0 || column >= header.columns)
        fail(formatted("has an entry in column %" PetscInt_FMT " of %lld", column, header.columns));
    }
    std::sort(list.begin(), list.end());
    const auto twice = std::adjacent_find(list.begin(), list.end());
    if (twice != list.end())
      fail(formatted("has two entries in column %" PetscInt_FMT "; this format stores each once",
                     *twice));
  }
  if (left != 0)
    throw Error(formatted("the rows have %lld entries, the header announces %lld",
                          header.entries - left, header.entries));
}

void checkValues(const std::filesystem::path& path, const Header& header) {
  BinaryFile values(path);
  values.seek(header.valuesBegin());
  for (long long k = 0; k < header.entries; ++k)
    if (!std::isfinite(values.number<double>(swapped)))
      throw Error(formatted("entry %lld of %lld is not a finite number", k + 1, header.entries));
}

}  // namespace

void requirePetscBinary(const std::filesystem::path& path) {
  BinaryFile file(path);
  const Header header = headerOf(file);
  if (file.size() != header.end())
    throw Error(formatted("%" PRIu64 " bytes, but a real matrix of %lld rows and %lld entries with "
                          "%lld-bit indices takes %" PRIu64
                          ": truncated, or of another PETSc configuration",
                          file.size(), header.rows, header.entries, 8 * indexBytes, header.end()));
  requireSquare(header.rows, header.columns);
  checkPattern(path, header);
  checkValues(path, header);
}

}  // namespace squeal::matrixfile
