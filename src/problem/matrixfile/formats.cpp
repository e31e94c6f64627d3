// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrixfile/formats.hpp"

#include <petscmat.h>
#include <strings.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "base/system/unreadable.hpp"
#include "problem/matrixfile/bytes.hpp"

namespace squeal::matrixfile {
namespace {

constexpr long long mostIndices = std::numeric_limits<PetscInt>::max();

void requireCountable(long long count, const char* what) {
  if (count > mostIndices)
    throw Error(formatted("%lld %s: this build's %zu-bit indices count to %lld", count, what,
                          8 * sizeof(PetscInt), mostIndices));
}

std::string firstBytes(const std::filesystem::path& path, std::size_t count) {
  if (const auto why = whyUnreadable(path); !why.empty()) throw Error(why);
  const auto status = std::filesystem::status(path);
  if (std::filesystem::is_directory(status)) throw Error("a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw Error("not a regular file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(std::string("cannot be read: ") + std::strerror(errno));
  std::string bytes(count, '\0');
  file.read(bytes.data(), count);
  bytes.resize(file.gcount());
  if (bytes.empty()) throw Error("the file is empty");
  return bytes;
}

bool begins(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// Returns true if the text begins with `start`, ignoring case.
bool beginsAsWord(const std::string& text, const char* start) {
  return strncasecmp(text.c_str(), start, std::strlen(start)) == 0;
}

std::int32_t wordAt(const std::string& bytes, std::size_t position, bool big) {
  return position + 4 > bytes.size()
             ? 0
             : numberAt<std::int32_t>(bytes.data() + position, big == littleEndian);
}

/// Returns true for a MATLAB file of version 5. The header of 128 bytes ends with the version and
/// the byte-order mark; the text before them is arbitrary.
bool isMatlab5(const std::string& head) {
  if (begins(head, "MATLAB 5.0 MAT-file")) return true;
  return head.size() == 128 && (head.substr(124) == std::string("\0\1IM", 4) ||
                                head.substr(124) == std::string("\1\0MI", 4));
}

/// Returns true for an HDF5 file. MATLAB files of version 7.3 have an additional header before that
/// of HDF5.
bool isHdf5(const std::string& head) {
  const std::string signature = "\x89HDF\r\n\x1a\n";
  return begins(head, signature) || begins(head, "MATLAB 7.3 MAT-file") ||
         (head.size() >= 520 && head.compare(512, signature.size(), signature) == 0);
}

/// Returns true for a MATLAB file of version 4. It has no signature; its header contains type,
/// rows, columns, a flag for an imaginary part, and the length of the name.
bool isMatlab4(const std::string& head) {
  const auto looksSound = [&](bool big) {
    const auto at = [&](std::size_t word) { return wordAt(head, 4 * word, big); };
    return head.size() >= 20 && at(0) >= 0 && at(0) < 5000 && at(1) >= 0 && at(2) >= 0 &&
           (at(3) == 0 || at(3) == 1) && at(4) > 0;
  };
  return looksSound(true) || looksSound(false);
}

std::string beginningOf(const std::string& head) {
  std::string text;
  for (const char c : head.substr(0, 24)) {
    if (c == '\n') break;
    text += c >= ' ' && c <= '~' ? std::string(1, c) : formatted("\\x%02hhx", c);
  }
  return text;
}

constexpr int ownIndexBits = 8 * sizeof(PetscInt);

/// Returns the bits of the indices of a matrix in PETSc's binary format; 0 for anything else.
int indexBits(const std::string& head) {
  if (wordAt(head, 0, true) == MAT_FILE_CLASSID) return 32;
  return wordAt(head, 0, true) == 0 && wordAt(head, 4, true) == MAT_FILE_CLASSID ? 64 : 0;
}

/// Throws Error for a file of another format, naming the format if it is known.
[[noreturn]] void rejectFormat(const std::string& head) {
  if (begins(head, "PK"))
    throw Error(
        "an archive of numpy or scipy.sparse.save_npz: convert it to .mtx or .h5 by "
        "scripts/convert_matrix");
  if (begins(head, "\x93NUMPY"))
    throw Error("an array of numpy: convert it to .mtx or .h5 by scripts/convert_matrix");
  if (begins(head, "\x1f\x8b")) throw Error("a file compressed by gzip: decompress it first");
  if (const int bits = indexBits(head); bits > 0)
    throw Error(
        formatted("a matrix in PETSc's binary format with %d-bit indices: write it with %d-bit "
                  "indices, those of this build",
                  bits, ownIndexBits));
  if (wordAt(head, 0, false) == MAT_FILE_CLASSID)
    throw Error("a matrix in PETSc's binary format, but little-endian: the format is big-endian");
  if (wordAt(head, 0, true) == VEC_FILE_CLASSID)
    throw Error("a vector in PETSc's binary format, not a matrix");
  throw Error(
      "the file is none of Matrix Market (first line %%MatrixMarket ...), MATLAB, HDF5 and PETSc's "
      "binary format: it begins with "
      "'" +
      beginningOf(head) + "'");
}

}  // namespace

Entries::Entries(long long rowCount, long long columnCount) {
  if (rowCount < 0 || columnCount < 0)
    throw Error(formatted("%lld rows and %lld columns", rowCount, columnCount));
  requireCountable(rowCount, "rows");
  requireCountable(columnCount, "columns");
  rows = rowCount;
  columns = columnCount;
}

void Entries::add(long long i, long long j, double x) {
  if (i < 0 || j < 0 || i >= rows || j >= columns)
    throw Error(formatted("an entry in row %lld and column %lld of a matrix of %" PetscInt_FMT
                          " x %" PetscInt_FMT " (counted from 0)",
                          i, j, rows, columns));
  if (!std::isfinite(x))
    throw Error(formatted(
        "the entry in row %lld and column %lld (counted from 0) is not a finite number", i, j));
  if (x == 0) return;
  requireCountable(std::ssize(value) + 1, "entries");
  row.push_back(i);
  column.push_back(j);
  value.push_back(x);
}

void requireSquare(long long rows, long long columns) {
  if (rows != columns)
    throw Error(formatted("%lld rows and %lld columns, not square", rows, columns));
  if (rows <= 0) throw Error("a matrix without rows");
  requireCountable(rows, "rows");
}

Entries Compressed::entries() const {
  const long long lists = byColumns ? columns : rows;
  if (std::ssize(begin) != lists + 1)
    throw Error(formatted("%s has %zu numbers where a matrix of %lld x %lld by %s takes %lld",
                          beginName, begin.size(), rows, columns, byColumns ? "columns" : "rows",
                          lists + 1));
  if (begin.front() != 0)
    throw Error(formatted("%s begins with %lld, not with 0", beginName, begin.front()));
  for (std::size_t k = 0; k + 1 < begin.size(); ++k)
    if (begin[k + 1] < begin[k])
      throw Error(formatted("%s falls from %lld to %lld", beginName, begin[k], begin[k + 1]));
  if (begin.back() != std::ssize(index) || begin.back() != std::ssize(value))
    throw Error(formatted("%s ends with %lld, but %s has %zu numbers and data has %zu", beginName,
                          begin.back(), indexName, index.size(), value.size()));
  Entries entries(rows, columns);
  for (long long k = 0; k < lists; ++k)
    for (long long e = begin[k]; e < begin[k + 1]; ++e)
      entries.add(byColumns ? index[e] : k, byColumns ? k : index[e], value[e]);
  return entries;
}

void Compressed::dropFree() {
  if (begin.empty() || begin.back() < 0) return;
  const std::size_t count = begin.back();
  if (index.size() > count) index.resize(count);
  if (value.size() > count) value.resize(count);
}

Format formatOf(const std::filesystem::path& path) {
  const std::string all = firstBytes(path, 520), head = all.substr(0, 128);
  if (beginsAsWord(head, "%%MatrixMarket")) return Format::matrixMarket;
  if (isHdf5(all)) return Format::hdf5;
  if (isMatlab5(head)) return Format::matlab;
  if (indexBits(head) == ownIndexBits) return Format::petscBinary;
  if (path.extension() == ".mat" && isMatlab4(head)) return Format::matlab;
  rejectFormat(head);
}

}  // namespace squeal::matrixfile
