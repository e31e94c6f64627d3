#include <matio.h>

#include "fuzz/fuzz.hpp"
#include "matrices/matrices.hpp"

namespace squeal::fuzz {
namespace {

/// [[2, 0], [1, 3]], sparse or full, and a number beside it.
void write(const std::string& path, mat_ft version, matio_compression compression, bool full) {
  mat_t* file = Mat_CreateVer(path.c_str(), "seed", version);
  mat_uint32_t row[] = {0, 1, 1}, begin[] = {0, 2, 3};
  double data[] = {2, 1, 3}, all[] = {2, 1, 0, 3}, one = 1;
  mat_sparse_t sparse{3, row, 3, begin, 3, 3, data};
  std::size_t two[2] = {2, 2}, scalar[2] = {1, 1};
  matvar_t* variables[] = {Mat_VarCreate("mu", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, scalar, &one, 0),
                           full ? Mat_VarCreate("k", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, two, all, 0)
                                : Mat_VarCreate("k", MAT_C_SPARSE, MAT_T_DOUBLE, 2, two, &sparse, 0)};
  for (matvar_t* variable : variables) {
    Mat_VarWrite(file, variable, compression);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

/// Version 4, as MATLAB writes it: headers of type (1000 M + 100 O + 10 P + T), rows, columns, imaginary flag and length of the name,
/// in the byte order of the machine that wrote it. A sparse matrix has a row (i, j, x) for each entry, and one with its size.
std::string version4(bool sparse) {
  const std::int32_t head[] = {sparse ? 2 : 0, sparse ? 4 : 2, sparse ? 3 : 2, 0, 2};
  const std::vector<double> values =
      sparse ? std::vector<double>{1, 2, 2, 2, 1, 1, 2, 2, 2, 1, 3, 0} : std::vector<double>{2, 1, 0, 3};
  return std::string(reinterpret_cast<const char*>(head), sizeof head) + std::string("k\0", 2) +
         std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
}

}  // namespace

Target target() {
  const auto seed = [](mat_ft version, matio_compression compression, bool full) {
    return bytesWritten([&](const std::string& path) { write(path, version, compression, full); });
  };
  return {"matlab",
          ".mat",
          {seed(MAT_FT_MAT5, MAT_COMPRESSION_NONE, false), seed(MAT_FT_MAT5, MAT_COMPRESSION_NONE, true),
           seed(MAT_FT_MAT5, MAT_COMPRESSION_ZLIB, false), seed(MAT_FT_MAT73, MAT_COMPRESSION_NONE, false),
           seed(MAT_FT_MAT73, MAT_COMPRESSION_NONE, true), version4(true), version4(false)},
          [](const std::string& path) { matrices::read(PETSC_COMM_WORLD, path); }};
}

}  // namespace squeal::fuzz
