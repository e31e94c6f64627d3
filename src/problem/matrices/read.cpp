// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrices/read.hpp"

#include <array>
#include <cmath>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "problem/matrixfile/formats.hpp"
#include "problem/matrixfile/hdf5.hpp"
#include "problem/matrixfile/matlab.hpp"
#include "problem/matrixfile/matrix_market.hpp"
#include "problem/matrixfile/petsc_binary.hpp"

namespace squeal::matrices {
namespace {

/// Collective. Reads a file in PETSc's binary format; each rank reads its rows. A file NAME.info
/// next to it, from which PETSc would take options, is ignored.
OwnedMat load(MPI_Comm comm, const std::filesystem::path& path) {
  OwnedViewer viewer;
  OwnedMat matrix;
  check(PetscViewerCreate(comm, viewer.out()));
  check(PetscViewerSetType(viewer, PETSCVIEWERBINARY));
  check(PetscViewerFileSetMode(viewer, FILE_MODE_READ));
  check(PetscViewerBinarySkipInfo(viewer));
  check(PetscViewerFileSetName(viewer, path.c_str()));
  check(MatCreate(comm, matrix.out()));
  check(MatSetType(matrix, MATAIJ));
  check(MatLoad(matrix, viewer));
  return matrix;
}

/// Collective. Returns the matrix of the entries of rank 0. PETSc sums entries of equal row and
/// column. The insert mode only selects whether they are added to earlier values or replace them.
OwnedMat distribute(MPI_Comm comm, matrixfile::Entries& entries) {
  std::array<PetscInt, 2> sizes{entries.rows, entries.columns};
  mpi::broadcast(comm, sizes);
  OwnedMat matrix;
  check(MatCreate(comm, matrix.out()));
  check(MatSetSizes(matrix, PETSC_DECIDE, PETSC_DECIDE, sizes[0], sizes[1]));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetPreallocationCOO(matrix, entries.value.size(), entries.row.data(),
                               entries.column.data()));
  check(MatSetValuesCOO(matrix, entries.value.data(), INSERT_VALUES));
  return matrix;
}

/// Throws Error if there are far too few entries for the rows. A damaged header can request memory
/// for empty rows. Up to ten million rows, a gigabyte, are accepted; beyond, at least one row in a
/// thousand must have an entry.
void requireFilled(const matrixfile::Entries& entries) {
  const double count = entries.value.size();
  if (entries.rows > 1e7 + 1e3 * count)
    throw Error(formatted("%" PetscInt_FMT " rows with %.0f entries: is the number of rows right?",
                          entries.rows, count));
}

matrixfile::Entries readHere(matrixfile::Format format, const std::filesystem::path& path,
                             const std::string& dataset) {
  if (!dataset.empty() &&
      (format == matrixfile::Format::matrixMarket || format == matrixfile::Format::petscBinary))
    throw Error("the file is a single matrix without named objects such as '" + dataset + "'");
  matrixfile::Entries entries;
  switch (format) {
    case matrixfile::Format::matrixMarket:
      entries = matrixfile::readMatrixMarket(path);
      break;
    case matrixfile::Format::hdf5:
      entries = matrixfile::readHdf5(path, dataset);
      break;
    case matrixfile::Format::matlab:
      entries = matrixfile::readMatlab(path, dataset);
      break;
    case matrixfile::Format::petscBinary:
      matrixfile::requirePetscBinary(path);
      return entries;
  }
  matrixfile::requireSquare(entries.rows, entries.columns);
  requireFilled(entries);
  return entries;
}

}  // namespace

OwnedMat read(MPI_Comm comm, const std::filesystem::path& path, const std::string& dataset) {
  matrixfile::Entries entries;
  bool isBinary = false;
  onFirstRank(comm, path.string() + ": ", [&] {
    const matrixfile::Format format = matrixfile::formatOf(path);
    isBinary = format == matrixfile::Format::petscBinary;
    entries = readHere(format, path, dataset);
  });
  mpi::broadcast(comm, isBinary);
  OwnedMat matrix = isBinary ? load(comm, path) : distribute(comm, entries);
  PetscReal norm = 0;
  check(MatNorm(matrix, NORM_FROBENIUS, &norm));
  if (!std::isfinite(norm))
    throw Error(path.string() + ": the numbers are too large: their squares overflow");
  return matrix;
}

}  // namespace squeal::matrices
