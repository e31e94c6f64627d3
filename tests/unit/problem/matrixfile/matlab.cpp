// SPDX-License-Identifier: BSD-2-Clause
// MATLAB files of all versions, those of matio and those as MATLAB itself writes them, whole and
// cut short.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "problem/matrixfile/hdf5.hpp"
#include "problem/matrixfile/matlab.hpp"
#include "support/problem/hdf5_writer.hpp"
#include "support/problem/matlab_bytes.hpp"
#include "support/problem/matrix_files.hpp"

namespace squeal::test {
namespace {

/// By matio: a sparse and a full matrix, the full one by columns.
void writeMatlab(const std::string& path, mat_ft version, matio_compression compression) {
  mat_t* file = Mat_CreateVer(path.c_str(), "test", version);
  Lists lists(true);
  const auto count = static_cast<mat_uint32_t>(lists.data.size());
  mat_sparse_t sparse{count, lists.indices.data(), count, lists.begin.data(), 5,
                      count, lists.data.data()};
  std::vector<double> full;
  for (std::size_t j = 0; j < 4; ++j)
    for (const auto& row : sample) full.push_back(row[j]);
  std::size_t dims[2] = {4, 4};
  matvar_t* variables[] = {
      Mat_VarCreate("sparse", MAT_C_SPARSE, MAT_T_DOUBLE, 2, dims, &sparse, 0),
      Mat_VarCreate("full", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, full.data(), 0)};
  for (matvar_t* variable : variables) {
    Mat_VarWrite(file, variable, compression);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

const std::vector<double> small{2, 1, 0, 3};  // by columns

TEST(Matlab, ByMatio) {
  for (const auto& [name, version, compression] :
       {std::tuple{"plain.mat", MAT_FT_MAT5, MAT_COMPRESSION_NONE},
        {"packed.mat", MAT_FT_MAT5, MAT_COMPRESSION_ZLIB},
        {"v73.mat", MAT_FT_MAT73, MAT_COMPRESSION_NONE},
        {"v73_packed.mat", MAT_FT_MAT73, MAT_COMPRESSION_ZLIB}}) {
    const auto path =
        written(name, [&, v = version, c = compression](const auto& to) { writeMatlab(to, v, c); });
    expectSample(path, "sparse");
    expectSample(path, "full");
    EXPECT_TRUE(contains(errorReading(path), "several matrices, ")) << errorReading(path);
    EXPECT_TRUE(contains(errorReading(path, "other"), "'other'")) << errorReading(path, "other");
  }
}

TEST(Matlab, AsMatlabWritesIt) {
  for (const bool big : {false, true}) {
    const std::string order = big ? "big_" : "little_";
    const std::string number = variable5(big, 6, {1, 1}, "mu",
                                         element(big, 9, Bytes(big).add(0.3).text())),
                      text = variable5(
                          big, 4, {1, 3}, "unit",
                          element(big, 4, Bytes(big).addAll<std::uint16_t>({78, 47, 109}).text()));
    EXPECT_EQ(valuesRead(writeFile(order + "v5_sparse.mat",
                                   header5(big) + number + sparse5(big, "k") + text)),
              small);
    EXPECT_EQ(valuesRead(
                  writeFile(order + "v5_full.mat", header5(big) + text + full5(big, "k") + number)),
              small);
    EXPECT_EQ(valuesRead(writeFile(order + "v4_full.mat", version4(big, 0, 2, 2, "k", small))),
              small);
    // The last row of a sparse matrix of version 4 is its size; the entry in row 1 and column 1
    // stands there twice and is summed.
    EXPECT_EQ(valuesRead(writeFile(
                  order + "v4_sparse.mat",
                  version4(big, 2, 5, 3, "k", {1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 1.5, 0.5, 1, 3, 0}))),
              small);
  }
}

/// The variables of MATLAB's version 7.3: HDF5 with classes as attributes, tables by columns,
/// sparse matrices as groups.
void writeVersion73(const std::string& path) {
  const Hdf5File file(path, 512);
  const double number[] = {0.3}, table[] = {2, 1, 0, 3}, data[] = {2, 1, 3};
  const std::uint64_t rows[] = {0, 1, 1}, begin[] = {0, 2, 3}, empty[] = {0, 0, 0}, size = 2;
  file.dataset("mu", H5T_NATIVE_DOUBLE, number, {1, 1});
  file.text("mu", "MATLAB_class", "double");
  file.dataset("full", H5T_NATIVE_DOUBLE, table, {2, 2});
  file.text("full", "MATLAB_class", "double");
  for (const std::string name : {"sparse", "nothing"}) {
    file.group(name);
    file.text(name, "MATLAB_class", "double");
    file.number(name, "MATLAB_sparse", H5T_NATIVE_UINT64, &size);
    file.dataset(name + "/jc", H5T_NATIVE_UINT64, name == "sparse" ? begin : empty, {3});
    if (name == "nothing") continue;  // MATLAB writes no lists of no entries
    file.dataset(name + "/ir", H5T_NATIVE_UINT64, rows, {3});
    file.dataset(name + "/data", H5T_NATIVE_DOUBLE, data, {3});
  }
  const std::uint16_t letters[] = {78, 47, 109};
  file.dataset("unit", H5T_NATIVE_UINT16, letters, {3, 1});
  file.text("unit", "MATLAB_class", "char");
}

TEST(Matlab, Version73AsMatlabWritesIt) {
  const auto path = written("matlab73.mat", [](const auto& to) {
    writeVersion73(to);
    std::string head =
        "MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Mon Jan 1 00:00:00 2024 HDF5 schema "
        "1.00 .";
    head.resize(124, ' ');
    std::fstream(to, std::ios::in | std::ios::out | std::ios::binary)
        << head << std::string("\0\2IM", 4);
  });
  EXPECT_EQ(valuesRead(path, "full"), small);
  EXPECT_EQ(valuesRead(path, "sparse"), small);
  EXPECT_EQ(valuesRead(path, "nothing"), (std::vector<double>{0, 0, 0, 0}));
  EXPECT_EQ(valuesRead(path, "mu"), std::vector<double>{0.3});
  EXPECT_TRUE(contains(errorReading(path), "several matrices, full, nothing, sparse: name one"))
      << errorReading(path);
  EXPECT_TRUE(contains(errorReading(path, "unit"), "'unit' is neither"))
      << errorReading(path, "unit");
  const auto read = [](const std::string& name) {
    return [name](const auto& from) { matrixfile::readHdf5(from, name); };
  };
  // The length of an HDF5 file stands at its beginning.
  EXPECT_EQ(cutsThatPass("cut73.mat", bytesOf(path), read("sparse"), 97),
            std::vector<std::size_t>{});
}

// What a file cut short no longer holds was read as zeros, or as a file without the variable.
TEST(Matlab, CutShortAtAnyByte) {
  for (const auto& [name, version, compression] :
       {std::tuple{"plain.mat", MAT_FT_MAT5, MAT_COMPRESSION_NONE},
        {"packed.mat", MAT_FT_MAT5, MAT_COMPRESSION_ZLIB}}) {
    const auto path =
        written(name, [&, v = version, c = compression](const auto& to) { writeMatlab(to, v, c); });
    const std::string bytes = bytesOf(path);
    std::uint32_t size = 0;  // of the first variable, which begins behind the header of 128 bytes
    std::copy(bytes.begin() + 132, bytes.begin() + 136, reinterpret_cast<char*>(&size));
    const auto read = [](const std::string& wanted) {
      return [wanted](const auto& from) { matrixfile::readMatlab(from, wanted); };
    };
    // Between two variables a file cut short is a sound one, and the first is whole.
    EXPECT_EQ(cutsThatPass("cut.mat", bytes, read("sparse")), std::vector<std::size_t>{136 + size})
        << name;
    EXPECT_EQ(cutsThatPass("cut.mat", bytes, read("full")), std::vector<std::size_t>{}) << name;
  }
  const std::string first = version4(false, 0, 2, 2, "k", small),
                    second = version4(true, 2, 2, 3, "f", {1, 2, 2, 2, -0.4, 0});
  const auto f = [](const auto& from) { matrixfile::readMatlab(from, "f"); };
  const auto k = [](const auto& from) { matrixfile::readMatlab(from, "k"); };
  EXPECT_EQ(cutsThatPass("cut4.mat", first + second, f), std::vector<std::size_t>{});
  EXPECT_EQ(cutsThatPass("cut4.mat", first + second, k), std::vector<std::size_t>{first.size()});
}

TEST(Matlab, WhatIsWrongIsNamed) {
  const std::string head = header5(false);
  const auto indices = [](const std::vector<double>& list) {
    return element(false, 5, Bytes().addAll<std::int32_t>(list).text());
  };
  const auto values = [](const std::vector<double>& list) {
    return element(false, 9, Bytes().addAll<double>(list).text());
  };
  const auto sparse = [&](const std::string& parts) {
    return head + variable5(false, 5, {2, 2}, "k", parts);
  };
  const std::string whole = head + full5(false, "k");
  const std::vector<std::array<std::string, 3>> cases{
      {"cut_value", whole.substr(0, whole.size() - 4),
       "the file is truncated: the variable at byte 128 takes 56 bytes, 52 are left"},
      {"long", whole + std::string(3, '\0'), "the file is truncated in the header of a variable"},
      {"garbage", whole + std::string(16, 'x'), "no variable at byte 192"},
      {"few", head + variable5(false, 6, {2, 2}, "k", values({1, 2, 3})),
       "3 values in a matrix of 2 x 2"},
      {"complex", head + variable5(false, 6 | 0x800, {2, 2}, "k", values(small) + values(small)),
       "k (2 x 2 complex double)"},
      {"logical", head + variable5(false, 9 | 0x200, {2, 2}, "k", element(false, 2, "\1\1\1\1")),
       "k (2 x 2 logical uint8)"},
      {"wide", head + variable5(false, 6, {1, 2}, "k", values({1, 2})),
       "no square matrix of real numbers, but k (1 x 2 double)"},
      {"nothing", head, "no square matrix of real numbers, but no variable"},
      {"type", head + variable5(false, 6, {2, 2}, "k", element(false, 77, "12345678")),
       "the unknown type 77"},
      {"infinite", head + variable5(false, 6, {2, 2}, "k", values({1, 2, 3, HUGE_VAL})),
       "row 1 and column 1 (counted from 0) is not a finite"},
      {"huge", head + variable5(false, 6, {2e9, 2e9}, "k", values({1})),
       "1 values in a matrix of 2000000000 x 2000000000"},
      {"jc_falls", sparse(indices({0, 1, 1}) + indices({0, 3, 2}) + values({2, 1, 3})),
       "jc falls from 3 to 2"},
      {"jc_begins", sparse(indices({0, 1, 1}) + indices({1, 2, 3}) + values({2, 1, 3})),
       "jc begins with 1, not with 0"},
      {"jc_short", sparse(indices({0, 1, 1}) + indices({0, 3}) + values({2, 1, 3})),
       "jc has 2 numbers where"},
      {"pr_short", sparse(indices({0, 1, 1}) + indices({0, 2, 3}) + values({2, 1})),
       "jc ends with 3, but ir has 3 numbers and data has 2"},
      {"ir_outside", sparse(indices({0, 1, 2}) + indices({0, 2, 3}) + values({2, 1, 3})),
       "row 2 and column 1"},
      {"ir_negative", sparse(indices({0, -1, 1}) + indices({0, 2, 3}) + values({2, 1, 3})),
       "row -1 and column 0"},
      {"surplus", sparse(indices({0, 1, 1}) + indices({0, 2, 3}) + values({2, 1, 3}) + values({1})),
       "longer than its parts"},
      {"v4_size", version4(false, 2, 1, 3, "k", {2.5, 2, 0}), "a size or an index of 2.5"},
      {"v4_index", version4(false, 2, 2, 3, "k", {3, 2, 1, 2, 7, 0}), "row 2 and column 0"},
      {"v4_huge", version4(false, 2, 1, 3, "k", {2e9, 2e9, 0}), "2000000000 rows with 0 entries"},
      {"v4_cut", version4(false, 0, 2000000000, 2000000000, "k", small),
       "longer than the rest of the file"},
  };
  for (const auto& [name, bytes, message] : cases) {
    const std::string error = errorReading(writeFile(name + ".mat", bytes));
    EXPECT_TRUE(contains(error, name + ".mat: ") && contains(error, message))
        << name << ": " << error;
  }
}

// An object of a class, as a table or a string is one, has no sizes; it is passed over if another
// variable is wanted.
TEST(Matlab, OtherVariablesAreNoHindrance) {
  const std::string object = element(
      false, 14,
      element(false, 6, Bytes().add(std::uint32_t{17}).add(std::uint32_t{0}).text()) +
          element(false, 1, "title") + element(false, 1, "MCOS") + element(false, 1, "string"));
  EXPECT_EQ(valuesRead(writeFile("objects.mat", header5(false) + object + sparse5(false, "k"))),
            small);
  EXPECT_TRUE(contains(errorReading(SQUEAL_OUTPUT_DIR "/objects.mat", "title"), "title (object)"));
}

}  // namespace
}  // namespace squeal::test
