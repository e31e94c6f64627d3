#pragma once
/// Matrix files, each format by the library of those who keep it. Not collective: for rank 0.
#include <petscsys.h>

#include <filesystem>
#include <string>
#include <vector>

namespace squeal::matrices {

/// All entries of a sparse matrix; those of equal row and column are summed.
struct Entries {
  PetscInt rows = 0, columns = 0;
  std::vector<PetscInt> row, column;
  std::vector<double> value;

  /// Zeros are left out. Error: an index outside the matrix.
  void add(long long i, long long j, double x);
};

/// Rows or columns one after the other, as compressed formats hold them: those from begin[k] to begin[k + 1] belong to row (or
/// column) k. Error: lists that do not fit together.
Entries compressed(long long rows, long long columns, bool byColumns, const std::vector<long long>& begin,
                   const std::vector<long long>& index, const std::vector<double>& value);

enum class Format { matrixMarket, petscBinary, hdf5, matlab };

/// What a file is, by its first bytes. Errors: no such file, an empty one, one of none of the formats.
Format formatOf(const std::filesystem::path& path);

/// Matrix Market (CHOLMOD): coordinate or array; general, symmetric or skew-symmetric; real, integer or pattern (ones). Error: another content
/// or damage.
Entries readMatrixMarket(const std::filesystem::path& path);

/// A MATLAB file of any version from 4 to 7.3 (matio): the variable `name`, sparse or full; empty: the only square matrix of the
/// file. Error: there is none, or several; complex or damaged content.
Entries readMatlab(const std::filesystem::path& path, const std::string& name);

/// HDF5: the object `name` (empty: the only matrix among the objects of the root, or the root itself), either a group with the
/// datasets data, indices and indptr of a compressed matrix, as SciPy's users and anndata write them (by rows, unless an attribute or
/// dataset "format", "h5sparse_format" or "encoding-type" begins with csc), or a dataset of two dimensions. Errors as above.
Entries readHdf5(const std::filesystem::path& path, const std::string& name);

/// Errors: a file that is not one real sparse matrix in PETSc's binary format with 32-bit indices, or is cut short.
void requirePetscBinary(const std::filesystem::path& path);

/// Writes Matrix Market, all entries. Error: the file cannot be written.
void writeMatrixMarket(const std::filesystem::path& path, const Entries& entries);

}  // namespace squeal::matrices
