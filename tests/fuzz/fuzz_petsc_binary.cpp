// SPDX-License-Identifier: BSD-2-Clause
#include <petscmat.h>

#include "fuzz/fuzz.hpp"
#include "problem/matrices/read.hpp"

namespace squeal::fuzz {
namespace {

void write(const std::string& path, PetscInt size,
           const std::vector<std::vector<PetscInt>>& columns) {
  OwnedMat matrix;
  check(MatCreateSeqAIJ(PETSC_COMM_SELF, size, size, size, nullptr, matrix.out()));
  for (PetscInt i = 0; i < size; ++i)
    for (const PetscInt j : columns[i])
      check(MatSetValue(matrix, i, j, 1.0 + i - 2.0 * j, INSERT_VALUES));
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  OwnedViewer viewer;
  check(PetscViewerBinaryOpen(PETSC_COMM_SELF, path.c_str(), FILE_MODE_WRITE, viewer.out()));
  check(PetscViewerBinarySkipInfo(viewer));
  check(MatView(matrix, viewer));
}

}  // namespace

Target target() {
  return {"petsc_binary",
          ".petsc",
          {bytesWritten([](const auto& path) {
             write(path, 2, {{0}, {0, 1}});
           }),
           bytesWritten([](const auto& path) {
             write(path, 5, {{0, 1, 4}, {}, {2, 3}, {0, 1, 2, 3, 4}, {4}});
           })},
          [](const std::string& path) { matrices::read(PETSC_COMM_WORLD, path); }};
}

}  // namespace squeal::fuzz
