#pragma once
/// Matrix files. A reader accepts what its format allows and rejects all else: nothing in a file is
/// ignored, and nothing that its header announces may be missing. Not collective: for rank 0. Every
/// Error gives the reason; none names the file.
#include <petscsys.h>

#include <filesystem>
#include <string>
#include <vector>

namespace squeal::matrixfile {

/// The entries of a sparse matrix; entries of equal row and column are summed.
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

/// A matrix in compressed rows or columns: the entries from begin[k] to begin[k + 1] belong to row
/// (or column) k.
struct Compressed {
  long long rows = 0, columns = 0;
  bool byColumns = false;
  std::vector<long long> begin, index;
  std::vector<double> value;
  const char *beginName = "indptr", *indexName = "indices";  ///< names in the format, for messages

  /// Shortens lists that go on after the last entry: MATLAB keeps places free, one at the least.
  void dropFree();
  /// Returns the entries. Throws Error if the lists do not fit together.
  Entries entries() const;
};

enum class Format { matrixMarket, petscBinary, hdf5, matlab };

/// Returns the format, from the first bytes of the file. Throws Error for a file that cannot be
/// read, is empty, or has none of the formats; the message then says what it is, where that is
/// known.
Format formatOf(const std::filesystem::path& path);

/// Reads Matrix Market: coordinate or array; general, symmetric or skew-symmetric; real, integer or
/// pattern (ones). Exponents may begin with D. A symmetric or skew-symmetric file holds one
/// triangle. Throws Error, with the number of the line, for anything else.
Entries readMatrixMarket(const std::filesystem::path& path);

/// Reads a MATLAB file of version 4 or 5 (as `save -v4`, `-v6` and `-v7` write): the variable
/// `name`, sparse or full. An empty name stands for the only square matrix of more than one row.
/// Throws Error if there is none or several of them, and for complex or damaged content, including
/// damaged sizes of other variables.
Entries readMatlab(const std::filesystem::path& path, const std::string& name);

/// Reads the object `name` of an HDF5 file. An empty name stands for the only matrix among the
/// objects of the root, or the root itself. The object is a dataset of two dimensions, or a group
/// with the datasets data, indices and indptr of a compressed matrix, as users of SciPy and anndata
/// write it. An attribute or dataset "format", "h5sparse_format" or "encoding-type" of the group
/// begins with csr or csc; without it only a symmetric matrix is read, which is the same by rows
/// and by columns. MATLAB files of version 7.3 are read too: groups with data, ir and jc, and
/// datasets of class double or single. Throws Error as readMatlab() does.
Entries readHdf5(const std::filesystem::path& path, const std::string& name);

/// Throws Error for a file that is not one square real sparse matrix in PETSc's binary format with
/// 32-bit indices, that is cut short, or that holds row lengths, columns or values with which
/// MatLoad() would end the program or misread it. Only one row is held in memory at a time.
void requirePetscBinary(const std::filesystem::path& path);

/// Writes all entries as Matrix Market. Throws Error if the file cannot be written.
void writeMatrixMarket(const std::filesystem::path& path, const Entries& entries);

}  // namespace squeal::matrixfile
