// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Common parts of the readers of matrix files. A reader accepts only valid files: it ignores no
/// part of the matrix that it reads, and requires everything that the header announces. The
/// functions of this folder are not collective: rank 0 calls them. Their Errors contain the reason,
/// but not the name of the file.
#include <petscsys.h>

#include <filesystem>
#include <vector>

namespace squeal::matrixfile {

/// The entries of a sparse matrix, with rows and columns counted from 0. Several entries may have
/// the same row and column; the matrix contains their sum.
struct Entries {
  Entries() = default;
  /// Throws Error if a size is negative or too large for a PetscInt.
  Entries(long long rows, long long columns);

  PetscInt rows = 0, columns = 0;
  std::vector<PetscInt> row, column;
  std::vector<double> value;

  /// Adds an entry unless it is zero. Throws Error for an index outside the matrix, for a value
  /// that is not finite, and for more entries than PetscInt can count.
  void add(long long i, long long j, double x);
};

/// Throws Error if the matrix is not square, has no rows, or has more rows than PetscInt can count.
void requireSquare(long long rows, long long columns);

/// A matrix in compressed rows or columns. Row (or column) k has the entries from begin[k] up to
/// but not including begin[k + 1].
struct Compressed {
  long long rows = 0, columns = 0;
  bool byColumns = false;
  std::vector<long long> begin, index;
  std::vector<double> value;
  const char *beginName = "indptr", *indexName = "indices";  ///< their names in messages

  /// Removes unused places after the last entry. MATLAB files may contain some.
  void dropFree();
  /// Returns the entries. Throws Error if the lists are inconsistent.
  Entries entries() const;
};

enum class Format { matrixMarket, petscBinary, hdf5, matlab };

/// Returns the format of a file, found from its first bytes. Throws Error for a file that cannot be
/// read, is empty, or has none of these formats; the message names the actual format if it is
/// recognised.
Format formatOf(const std::filesystem::path& path);

}  // namespace squeal::matrixfile
