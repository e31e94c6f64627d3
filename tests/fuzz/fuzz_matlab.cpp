// SPDX-License-Identifier: BSD-2-Clause
#include <matio.h>

#include "fuzz/fuzz.hpp"
#include "problem/matrices/read.hpp"
#include "support/problem/matlab_bytes.hpp"

namespace squeal::fuzz {
namespace {

/// [[2, 0], [1, 3]], sparse or full, and a number beside it.
void write(const std::string& path, mat_ft version, matio_compression compression, bool full) {
  mat_t* file = Mat_CreateVer(path.c_str(), "seed", version);
  mat_uint32_t row[] = {0, 1, 1}, begin[] = {0, 2, 3};
  double data[] = {2, 1, 3}, all[] = {2, 1, 0, 3}, one = 1;
  mat_sparse_t sparse{3, row, 3, begin, 3, 3, data};
  std::size_t two[2] = {2, 2}, scalar[2] = {1, 1};
  matvar_t* variables[] = {
      Mat_VarCreate("mu", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, scalar, &one, 0),
      full ? Mat_VarCreate("k", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, two, all, 0)
           : Mat_VarCreate("k", MAT_C_SPARSE, MAT_T_DOUBLE, 2, two, &sparse, 0)};
  for (matvar_t* variable : variables) {
    Mat_VarWrite(file, variable, compression);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

}  // namespace

Target target() {
  const auto seed = [](mat_ft version, matio_compression compression, bool full) {
    return bytesWritten([&](const std::string& path) { write(path, version, compression, full); });
  };
  return {"matlab",
          ".mat",
          {seed(MAT_FT_MAT5, MAT_COMPRESSION_NONE, false),
           seed(MAT_FT_MAT5, MAT_COMPRESSION_NONE, true),
           seed(MAT_FT_MAT5, MAT_COMPRESSION_ZLIB, false),
           seed(MAT_FT_MAT73, MAT_COMPRESSION_NONE, false),
           seed(MAT_FT_MAT73, MAT_COMPRESSION_NONE, true),
           test::version4(false, 2, 4, 3, "k", {1, 2, 2, 2, 1, 1, 2, 2, 2, 1, 3, 0}),
           test::version4(true, 0, 2, 2, "k", {2, 1, 0, 3}),
           test::header5(false) + test::sparse5(false, "k"),
           test::header5(true) + test::full5(true, "k")},
          [](const std::string& path) { matrices::read(PETSC_COMM_WORLD, path); }};
}

}  // namespace squeal::fuzz
