#include "matrices/formats.hpp"

#include <petscmat.h>

#include <array>
#include <cstdint>
#include <fstream>

#include "petsc/check.hpp"
#include "petsc/text.hpp"

namespace squeal::matrices {
namespace {

bool begins(const std::string& text, const std::string& start) { return text.compare(0, start.size(), start) == 0; }

std::string firstBytes(const std::filesystem::path& path, std::size_t count) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) throw Error("there is no such file");
  std::string bytes(count, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.empty()) throw Error("the file is empty");
  return bytes;
}

/// PETSc's binary files are big-endian.
std::int32_t bigEndian(const std::string& bytes, std::size_t word) {
  std::uint32_t x = 0;
  for (std::size_t i = 0; i < 4; ++i) x = x << 8 | static_cast<unsigned char>(bytes.at(4 * word + i));
  return static_cast<std::int32_t>(x);
}

bool isPetscMatrix(const std::string& bytes) { return bytes.size() >= 16 && bigEndian(bytes, 0) == MAT_FILE_CLASSID; }

}  // namespace

void Entries::add(long long i, long long j, double x) {
  if (i < 0 || j < 0 || i >= rows || j >= columns)
    throw Error(formatted("an entry in row %lld and column %lld of a %lld x %lld matrix (counted from 0)", i, j,
                          static_cast<long long>(rows), static_cast<long long>(columns)));
  if (x == 0) return;
  row.push_back(static_cast<PetscInt>(i));
  column.push_back(static_cast<PetscInt>(j));
  value.push_back(x);
}

Entries compressed(long long rows, long long columns, bool byColumns, const std::vector<long long>& begin,
                   const std::vector<long long>& index, const std::vector<double>& value) {
  const long long lists = byColumns ? columns : rows, count = static_cast<long long>(value.size());
  if (static_cast<long long>(begin.size()) != lists + 1 || begin.front() != 0 || begin.back() > count ||
      index.size() < value.size())
    throw Error("the lists of a compressed matrix do not fit together");
  Entries entries{static_cast<PetscInt>(rows), static_cast<PetscInt>(columns), {}, {}, {}};
  for (std::size_t k = 0; k + 1 < begin.size(); ++k) {
    if (begin[k + 1] < begin[k] || begin[k + 1] > count) throw Error("the lists of a compressed matrix do not fit together");
    for (auto e = static_cast<std::size_t>(begin[k]); e < static_cast<std::size_t>(begin[k + 1]); ++e) {
      const auto list = static_cast<long long>(k);
      entries.add(byColumns ? index[e] : list, byColumns ? list : index[e], value[e]);
    }
  }
  return entries;
}

Format formatOf(const std::filesystem::path& path) {
  const std::string head = firstBytes(path, 128);
  if (begins(head, "%%MatrixMarket")) return Format::matrixMarket;
  if (begins(head, "MATLAB 5.0 MAT-file") || begins(head, "MATLAB 7.3 MAT-file")) return Format::matlab;
  if (begins(head, "\x89HDF\r\n\x1a\n")) return Format::hdf5;
  if (isPetscMatrix(head)) return Format::petscBinary;
  if (begins(head, "PK"))
    throw Error("an archive, as numpy and scipy.sparse.save_npz write it: make scripts/convert_matrix a .mtx or .h5 of it");
  if (path.extension() == ".mat") return Format::matlab;  // version 4 has no signature
  throw Error("the file is none of Matrix Market (first line %%MatrixMarket ...), MATLAB, HDF5 and PETSc's binary format");
}

void requirePetscBinary(const std::filesystem::path& path) {
  const std::string head = firstBytes(path, 16);
  if (!isPetscMatrix(head)) throw Error("not a matrix in PETSc's binary format");
  const long long rows = bigEndian(head, 1), nonzeros = bigEndian(head, 3);
  if (nonzeros < 0) throw Error("a dense matrix in PETSc's binary format; write a sparse one");
  const auto size = static_cast<long long>(std::filesystem::file_size(path));
  const long long wanted = 4 * (4 + rows + nonzeros) + 8 * nonzeros;
  if (rows < 0 || size != wanted)
    throw Error(
        formatted("%lld bytes where a real matrix of %lld rows and %lld entries with 32-bit indices takes %lld: cut short, or of "
                  "another PETSc configuration",
                  size, rows, nonzeros, wanted));
}

}  // namespace squeal::matrices
