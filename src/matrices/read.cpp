#include <cmath>

#include "matrices/formats.hpp"
#include "matrices/matrices.hpp"
#include "petsc/text.hpp"

namespace squeal::matrices {
namespace {

/// Each rank reads its rows.
OwnedMat load(MPI_Comm comm, const std::filesystem::path& path) {
  OwnedViewer viewer;
  OwnedMat matrix;
  check(PetscViewerBinaryOpen(comm, path.c_str(), FILE_MODE_READ, viewer.out()));
  check(MatCreate(comm, matrix.out()));
  check(MatSetType(matrix, MATAIJ));
  check(MatLoad(matrix, viewer));
  return matrix;
}

/// From the entries that rank 0 has.
OwnedMat distribute(MPI_Comm comm, Entries& entries) {
  PetscInt sizes[2] = {entries.rows, entries.columns};
  check(MPI_Bcast(sizes, 2, MPIU_INT, 0, comm));
  OwnedMat matrix;
  check(MatCreate(comm, matrix.out()));
  check(MatSetSizes(matrix, PETSC_DECIDE, PETSC_DECIDE, sizes[0], sizes[1]));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetPreallocationCOO(matrix, static_cast<PetscCount>(entries.value.size()), entries.row.data(), entries.column.data()));
  check(MatSetValuesCOO(matrix, entries.value.data(), INSERT_VALUES));
  return matrix;
}

Entries readHere(Format format, const std::filesystem::path& path, const std::string& dataset) {
  Entries entries;
  switch (format) {
    case Format::matrixMarket:
      entries = readMatrixMarket(path);
      break;
    case Format::hdf5:
      entries = readHdf5(path, dataset);
      break;
    case Format::matlab:
      entries = readMatlab(path, dataset);
      break;
    case Format::petscBinary:
      requirePetscBinary(path);
      break;
  }
  if (entries.rows != entries.columns)
    throw Error(formatted("%d rows and %d columns, not square", static_cast<int>(entries.rows), static_cast<int>(entries.columns)));
  if (entries.rows == 0 && format != Format::petscBinary) throw Error("a matrix without rows");
  return entries;
}

}  // namespace

OwnedMat read(MPI_Comm comm, const std::filesystem::path& path, const std::string& dataset) {
  Entries entries;
  int isBinary = 0;
  onFirstRank(comm, path.string() + ": ", [&] {
    const Format format = formatOf(path);
    isBinary = format == Format::petscBinary;
    entries = readHere(format, path, dataset);
  });
  check(MPI_Bcast(&isBinary, 1, MPI_INT, 0, comm));
  OwnedMat matrix = isBinary ? load(comm, path) : distribute(comm, entries);
  PetscInt rows = 0, columns = 0;
  PetscReal norm = 0;
  check(MatGetSize(matrix, &rows, &columns));
  if (rows != columns)
    throw Error(
        formatted("%s: %d rows and %d columns, not square", path.c_str(), static_cast<int>(rows), static_cast<int>(columns)));
  check(MatNorm(matrix, NORM_FROBENIUS, &norm));
  if (!std::isfinite(norm)) throw Error(path.string() + ": an entry is not a finite number");
  return matrix;
}

}  // namespace squeal::matrices
