// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Matrix files to read, sound and damaged.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "problem/matrices/read.hpp"
#include "problem/matrixfile/formats.hpp"
#include "support/model/model.hpp"

namespace squeal::test {

// Unsymmetric, with an empty row, a full one, and a number that needs all its digits.
inline const std::array<std::array<double, 4>, 4> sample{
    {{1. / 3, 0, -2, 0}, {0, 0, 0, 0}, {5, 1e-300, 7, 8}, {0, 0, 0, -1e10 / 3}}};

inline matrixfile::Entries sampleEntries() {
  matrixfile::Entries entries(4, 4);
  for (long long i = 0; i < 4; ++i)
    for (long long j = 0; j < 4; ++j) entries.add(i, j, sample[i][j]);
  return entries;
}

/// The sample by rows, or by columns.
struct Lists {
  std::vector<double> data;
  std::vector<unsigned> indices, begin{0};
  explicit Lists(bool byColumns) {
    for (unsigned k = 0; k < 4; ++k) {
      for (unsigned l = 0; l < 4; ++l)
        if (const double x = byColumns ? sample[l][k] : sample[k][l]; x != 0)
          data.push_back(x), indices.push_back(l);
      begin.push_back(static_cast<unsigned>(data.size()));
    }
  }
};

inline int rankHere() {
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  return rank;
}

/// Collective. `write(path)` on one rank before any reads.
template <class Write>
std::string written(const std::string& name, const Write& write) {
  const std::string path = SQUEAL_OUTPUT_DIR "/" + name;
  if (rankHere() == 0) write(path);
  check(MPI_Barrier(PETSC_COMM_WORLD));
  return path;
}

/// Collective. All entries by columns; that every rank reads the same is part of it.
inline std::vector<double> valuesRead(const std::string& path, const std::string& dataset = {}) {
  const auto all = denseCopy(matrices::read(PETSC_COMM_WORLD, path, dataset));
  return {all.entries().begin(), all.entries().end()};
}

/// Collective.
inline void expectSample(const std::string& path, const std::string& dataset = {}) {
  const OwnedMat matrix = matrices::read(PETSC_COMM_WORLD, path, dataset);
  const auto all = denseCopy(matrix);
  ASSERT_EQ(all.rows(), 4) << path;
  ASSERT_EQ(all.columns(), 4) << path;
  for (PetscInt i = 0; i < 4; ++i)
    for (PetscInt j = 0; j < 4; ++j)
      EXPECT_EQ(all(i, j), sample[i][j]) << path << " " << i << " " << j;
}

/// Collective. Empty where the file is read.
inline std::string errorReading(const std::string& path, const std::string& dataset = {}) {
  return errorOf([&] { matrices::read(PETSC_COMM_WORLD, path, dataset); });
}

inline std::string bytesOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Lengths below that of the whole, 0, `step`, 2 `step`, ..., at which a file made of the first
/// bytes of `bytes` is read without an error by `read(path)`. Not collective: each rank has a file
/// of its own.
template <class Read>
std::vector<std::size_t> cutsThatPass(const std::string& name, const std::string& bytes,
                                      const Read& read, std::size_t step = 1) {
  const std::string path = SQUEAL_OUTPUT_DIR "/rank" + std::to_string(rankHere()) + "_" + name;
  std::vector<std::size_t> lengths;
  for (std::size_t length = 0; length < bytes.size(); length += step) {
    std::ofstream(path, std::ios::binary) << bytes.substr(0, length);
    const std::string error = errorOf([&] { read(path); });
    if (error.empty()) lengths.push_back(length);
    EXPECT_FALSE(contains(error, "std::") || contains(error, "vector")) << length << ": " << error;
  }
  return lengths;
}

}  // namespace squeal::test
