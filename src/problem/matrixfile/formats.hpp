// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Common parts of the readers of matrix files. A reader accepts only valid files: it ignores
/// nothing in a file, and requires everything that the header announces. The functions of this room
/// are not collective; rank 0 calls them. Their Errors contain the reason, but not the name of the
/// file.
#include <petscsys.h>

#include <filesystem>
#include <vector>

namespace squeal::matrixfile {

/// The entries of a sparse matrix, with rows and columns counted from 0. Entries of equal row and
/// column are summed.
struct Entries {
  Entries() = default;
  /// Throws Error if a size is negative or exceeds PetscInt.
  Entries(long long rows, long long columns);

  PetscInt rows = 0, columns = 0;
  std::vector<PetscInt> row, column;
  std::vector<double> value;

  /// Adds an entry unless it is zero. Throws Error for an index outside the matrix, for a value
  /// that is not finite, and for more entries than PetscInt can count.
  void add(long long i, long long j, double x);
};

/// Throws Error if the matrix is not square, has no rows, or has more than PetscInt can count.
void requireSquare(long long rows, long long columns);

/// A matrix in compressed rows or columns. Row (or column) k has the entries begin[k] to begin[k +
/// 1], the latter excluded.
struct Compressed {
  long long rows = 0, columns = 0;
  bool byColumns = false;
  std::vector<long long> begin, index;
  std::vector<double> value;
  const char *beginName = "indptr", *indexName = "indices";  ///< names in the format, for messages

  /// Removes unused space after the last entry; MATLAB stores at least one unused entry.
  void dropFree();
  /// Returns the entries. Throws Error if the lists are inconsistent.
  Entries entries() const;
};

enum class Format { matrixMarket, petscBinary, hdf5, matlab };

/// Returns the format, from the first bytes of the file. Throws Error for a file that cannot be
/// read, is empty, or has none of the formats; the message names the actual
/// format if it is known.
Format formatOf(const std::filesystem::path& path);

}  // namespace squeal::matrixfile
