#pragma once
/// Matrix files. A reader takes what its format allows and refuses the rest: nothing in a file is
/// passed over, and nothing that its header promises may be missing. Not collective: for rank 0.
/// Every Error says why; none names the file.
#include <petscsys.h>

#include <filesystem>
#include <string>
#include <vector>

namespace squeal::matrixfile {

/// All entries of a sparse matrix; those of equal row and column are summed.
struct Entries {
  Entries() = default;
  /// Error: negative; more than PETSc's index type can count.
  Entries(long long rows, long long columns);

  PetscInt rows = 0, columns = 0;
  std::vector<PetscInt> row, column;
  std::vector<double> value;

  /// Zeros are left out. Error: an index outside the matrix; a value that is not finite; more
  /// entries than PETSc can count.
  void add(long long i, long long j, double x);
};

/// Error: not square; no rows; more than PETSc's index type can count.
void requireSquare(long long rows, long long columns);

/// Rows or columns one after the other, as compressed formats hold them: those from begin[k] to
/// begin[k + 1] belong to row (or column) k.
struct Compressed {
  long long rows = 0, columns = 0;
  bool byColumns = false;
  std::vector<long long> begin, index;
  std::vector<double> value;
  const char *beginName = "indptr", *indexName = "indices";  ///< of the format, for messages

  /// Error: lists that do not fit together.
  Entries entries() const;
};

enum class Format { matrixMarket, petscBinary, hdf5, matlab };

/// The format that the first bytes of a file tell. Errors: a file that cannot be read, an empty
/// one, one of none of the formats; what it is then.
Format formatOf(const std::filesystem::path& path);

/// Matrix Market: coordinate or array; general, symmetric or skew-symmetric; real, integer or
/// pattern (ones). Exponents may begin with D. A symmetric or skew-symmetric file holds one
/// triangle. Error: anything else, with the number of the line.
Entries readMatrixMarket(const std::filesystem::path& path);

/// A MATLAB file of version 4 or 5 (what `save -v4`, `-v6` and `-v7` write): the variable `name`,
/// sparse or full; empty: the only square matrix of more than one row. Error: there is none, or
/// several; complex or damaged content, in the sizes of other variables as well.
Entries readMatlab(const std::filesystem::path& path, const std::string& name);

/// HDF5: the object `name` (empty: the only matrix among the objects of the root, or the root
/// itself), either a group with the datasets data, indices and indptr of a compressed matrix, as
/// SciPy's users and anndata write them, or a dataset of two dimensions. An attribute or dataset
/// "format", "h5sparse_format" or "encoding-type" of the group begins with csr or csc; without it
/// only a symmetric matrix is read, which is the same by rows and by columns. Likewise MATLAB's
/// files of version 7.3: groups with data, ir and jc, and datasets of class double or single.
/// Errors as above.
Entries readHdf5(const std::filesystem::path& path, const std::string& name);

/// Errors: a file that is not one square real sparse matrix in PETSc's binary format with 32-bit
/// indices, is cut short, or holds row lengths, columns or values that MatLoad() would end the
/// program at or misread. Holds one row at a time.
void requirePetscBinary(const std::filesystem::path& path);

/// Writes Matrix Market, all entries. Error: the file cannot be written.
void writeMatrixMarket(const std::filesystem::path& path, const Entries& entries);

}  // namespace squeal::matrixfile
