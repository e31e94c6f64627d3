// SPDX-License-Identifier: BSD-2-Clause
// Matrix Market files: read as the format says, or refused by line; and which file is of which
// format.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "problem/matrixfile/matrix_market.hpp"
#include "support/problem/matrix_files.hpp"

namespace squeal::test {
namespace {

const std::string head = "%%MatrixMarket matrix coordinate ", real = head + "real general\n",
                  size2 = real + "2 2 ";

TEST(MatrixMarket, Sample) {
  expectSample(written("sample.mtx", [](const auto& path) {
    matrixfile::writeMatrixMarket(path, sampleEntries());
  }));
  expectSample(writeFile("array.mtx",
                         "%%MatrixMarket matrix array real general\n4 "
                         "4\n.33333333333333331\n0\n5\n0\n0\n0\n1e-300\n0\n-2\n0\n7\n0\n0\n0\n8\n"
                         "-3333333333.3333335\n"));
}

TEST(MatrixMarket, WhatIsWrittenIsReadBitForBit) {
  using Limits = std::numeric_limits<double>;
  matrixfile::Entries entries(3, 3);
  for (const double x : {0.1, 1. / 3, Limits::denorm_min(), Limits::min(), Limits::max(),
                         1 + Limits::epsilon(), 2. / 3 * 1e-310})
    entries.add(0, 1, x), entries.add(2, 0, -x);
  const auto path =
      written("bits.mtx", [&](const auto& to) { matrixfile::writeMatrixMarket(to, entries); });
  const auto back = matrixfile::readMatrixMarket(path);
  EXPECT_EQ(back.value, entries.value);
  EXPECT_EQ(back.row, entries.row);
  EXPECT_EQ(back.column, entries.column);
}

struct Sound {
  std::string name, text;
  std::vector<double> values;  ///< by rows
};

TEST(MatrixMarket, WhatIsRead) {
  const std::string array = "%%MatrixMarket matrix array ";
  const std::vector<Sound> cases{
      // Fortran writes exponents with D; read as far as the D, 4.0D+2 would be 4.
      {"fortran", size2 + "3\n1 1 4.0D+2\n1 2 0.25d-1\n2 2 +1.E+01\n", {400, 0.025, 0, 10}},
      {"windows",
       "%%MatrixMarket matrix coordinate real general\r\n% c\r\n2 2 1\r\n2 1 3\r\n",
       {0, 0, 3, 0}},
      {"no_end", size2 + "1\n2 1 3", {0, 0, 3, 0}},
      {"blank", real + "\n%\n\n2 2 2\n\n1 1 1\n  \n\t2\t 2 2 \n\n", {1, 0, 0, 2}},
      {"comment", size2 + "2\n1 1 1\n% between\n2 2 2\n%after\n", {1, 0, 0, 2}},
      {"case", "%%matrixmarket MATRIX Coordinate Real General\n1 1 1\n1 1 7\n", {7}},
      {"integer", head + "integer general\n2 2 2\n1 1 -3\n2 2 4\n", {-3, 0, 0, 4}},
      {"twice",
       size2 + "3\n1 2 1\n2 2 5\n1 2 2.5\n",
       {0, 3.5, 0, 5}},  // those of equal row and column are summed
      {"zero", size2 + "2\n1 1 0\n2 2 1\n", {0, 0, 0, 1}},
      {"none", size2 + "0\n", {0, 0, 0, 0}},
      {"symmetric", head + "real symmetric\n% comment\n2 2 2\n1 1 3\n2 1 4\n", {3, 4, 4, 0}},
      {"upper",
       head + "real symmetric\n2 2 2\n1 2 4\n2 2 3\n",
       {0, 4, 4, 3}},  // one triangle, the other one
      {"skew", head + "real skew-symmetric\n2 2 1\n2 1 4\n", {0, -4, 4, 0}},
      {"pattern", head + "pattern symmetric\n2 2 3\n1 1\n2 1\n2 2\n", {1, 1, 1, 1}},
      {"array_symmetric",
       array + "real symmetric\n3 3\n1\n2\n3\n4\n5\n6\n",
       {1, 2, 3, 2, 4, 5, 3, 5, 6}},
      {"array_skew", array + "real skew-symmetric\n3 3\n1\n2\n3\n", {0, -1, -2, 1, 0, -3, 2, 3, 0}},
  };
  for (const auto& [name, text, values] : cases) {
    std::vector<double> found;
    EXPECT_EQ(errorOf([&, &name = name, &text = text] {
                found = valuesRead(writeFile(name + ".mtx", text));
              }),
              "")
        << name;
    const auto n = static_cast<std::size_t>(values.size() == 9 ? 3 : values.size() == 4 ? 2 : 1);
    std::vector<double> byRows;  // denseCopy() has columns one after the other
    for (std::size_t i = 0; i < n && found.size() == n * n; ++i)
      for (std::size_t j = 0; j < n; ++j) byRows.push_back(found[j * n + i]);
    EXPECT_EQ(byRows, values) << name;
  }
}

TEST(MatrixMarket, WhatIsRefusedByLine) {
  const std::string array = "%%MatrixMarket matrix array real general\n";
  const std::vector<std::array<std::string, 3>> cases{
      {"comma", size2 + "2\n1 1 1\n2 2 4,9\n", "line 4: the value '4,9' is not a number"},
      {"row", size2 + "2\n1 1 1\n1.9 2 4\n", "line 4: row '1.9' is not a whole number"},
      {"column", size2 + "2\n1 1 1\n2 2e0 4\n", "line 4: column '2e0' is not a whole number"},
      {"hexadecimal", size2 + "1\n1 1 0x10\n", "line 3: the value '0x10' is not a number"},
      {"twice_d", size2 + "1\n1 1 1D2D3\n", "line 3: the value '1D2D3' is not a number"},
      {"sign", size2 + "1\n1 1 +-1\n", "line 3: the value '+-1' is not a number"},
      {"words", size2 + "2\n1 1 1\n2 2 one\n", "line 4: the value 'one' is not a number"},
      {"nan", size2 + "2\n1 1 nan\n2 2 1\n", "line 3: the value 'nan' is not a finite number"},
      {"inf", size2 + "2\n1 1 1\n2 2 -inf\n", "line 4: the value '-inf' is not a finite number"},
      {"large", size2 + "1\n1 1 1e400\n",
       "line 3: the value '1e400' is beyond the range of doubles"},
      {"no_value", size2 + "2\n1 1\n2 2\n", "line 3: 2 words instead of row, column and value"},
      {"two_values", size2 + "1\n1 1 1 1\n", "line 3: 4 words instead of row, column and value"},
      {"surplus", size2 + "1\n1 1 1\n2 2 1\n",
       "line 4: more than the 1 entries that the header announces"},
      {"surplus_word", size2 + "1\n1 1 1\nend\n", "line 4: more than the 1 entries"},
      {"short", size2 + "2\n1 1 1\n", "the file ends after 1 of the 2 entries"},
      {"zero_row", size2 + "1\n0 1 1\n", "line 3: row 0 is outside 1 to 2"},
      {"outside", size2 + "1\n3 1 1\n", "line 3: row 3 is outside 1 to 2"},
      {"outside_column", size2 + "1\n1 -1 1\n", "line 3: column -1 is outside 1 to 2"},
      {"both", head + "real symmetric\n2 2 2\n2 1 4\n1 2 4\n",
       "line 4: the entry in row 1 and column 2 is above the diagonal, earlier ones are below it: "
       "the format stores only the lower triangle of a symmetric matrix"},
      {"both_upper", head + "real skew-symmetric\n3 3 3\n1 2 4\n1 3 4\n% c\n3 1 4\n",
       "line 6: the entry in row 3 and column 1 is below the diagonal, earlier ones are above it: "
       "the format stores only the lower triangle of a skew-symmetric matrix"},
      {"skew_diagonal", head + "real skew-symmetric\n2 2 1\n1 1 4\n",
       "line 3: the diagonal of a skew-symmetric matrix is zero"},
      {"half", head + "integer general\n1 1 1\n1 1 1.5\n",
       "line 3: the value '1.5' of a matrix of integers"},
      {"complex", head + "complex general\n1 1 1\n1 1 1 1\n",
       "line 1: the matrix is complex, not real"},
      {"hermitian", head + "real hermitian\n1 1 1\n1 1 1\n",
       "line 1: 'hermitian' where general or symmetric"},
      {"quaternion", head + "quaternion general\n1 1 1\n1 1 1\n",
       "line 1: 'quaternion' where real"},
      {"vector", "%%MatrixMarket vector coordinate real general\n1 1 1\n1 1 1\n",
       "line 1: 'vector' where matrix"},
      {"no_kind", "%%MatrixMarket\n1 1 1\n1 1 1\n", "line 1: 1 words instead of"},
      {"no_size", real + "% nothing else\n",
       "the file ends before the line with the numbers of rows"},
      {"size", real + "2 2\n1 1 1\n", "line 2: 2 words instead of rows, columns and entries"},
      {"size_value", real + "2 2 1.5\n1 1 1\n",
       "line 2: the number of entries '1.5' is not a whole number"},
      {"negative", real + "-2 -2 1\n1 1 1\n", "line 2: a negative number of rows"},
      {"wide", real + "1 2 1\n1 1 1\n", "1 rows and 2 columns, not square"},
      {"no_rows", real + "0 0 0\n", "a matrix without rows"},
      {"array_short", array + "2 2\n1\n2\n3\n", "the file ends after 3 of the 4 entries"},
      {"array_surplus", array + "1 1\n1\n2\n", "line 4: more than the 1 entries"},
      {"array_words", array + "2 2\n1 2\n3 4\n", "line 3: 2 words instead of only the next value"},
      // Of the number in a header no memory is taken: an error at once.
      {"long", real + "2000000000 2000000000 1\n1 1 1\n", "2000000000 rows with 1 entries"},
      {"longer", real + "3000000000 3000000000 1\n1 1 1\n",
       sizeof(PetscInt) == 4 ? "3000000000 rows: this build's 32-bit indices count to 2147483647"
                             : "3000000000 rows with 1 entries"},
      {"many", size2 + "9000000000000000000\n1 1 1\n",
       "the file ends after 1 of the 9000000000000000000 entries"},
      {"too_many", size2 + "90000000000000000000\n1 1 1\n",
       "line 2: the number of entries '90000000000000000000' is not a whole number"},
      {"large_array", array + "2000000000 2000000000\n1\n",
       "the file ends after 1 of the 4000000000000000000 entries"},
  };
  for (const auto& [name, text, message] : cases) {
    const std::string error = errorReading(writeFile(name + ".mtx", text));
    EXPECT_TRUE(contains(error, name + ".mtx: " + message)) << name << ": " << error;
  }
}

TEST(MatrixFiles, TheFormatIsToldByTheContent) {
  const std::vector<std::array<std::string, 3>> cases{
      {"empty.mtx", "", "the file is empty"},
      {"text.dat", "1 2 3\n4 5 6\n", "it begins with '1 2 3'"},
      {"zeros.dat", std::string(3, '\0'), "it begins with '\\x00\\x00\\x00'"},
      {"notes.mat", "not a matrix at all, but a text\n",
       "it begins with 'not a matrix at all, but'"},
      {"damaged.h5", "\x89HDF\r\n\x1a\n nothing", "damaged"},
      {"damaged.mat", "MATLAB 5.0 MAT-file",
       "the header of the MATLAB file is truncated or damaged"},
      {"scipy.npz", "PK\x03\x04", "scripts/convert_matrix"},
      {"numpy.npy", "\x93NUMPY\x01", "scripts/convert_matrix"},
      {"packed.mtx.gz", "\x1f\x8b\x08", "compressed by gzip"},
      {"vector.petsc", std::string("\0\x12\x7b\x4e\0\0\0\0", 8),
       "a vector in PETSc's binary format"},
      {"little.petsc", std::string("\x50\x7b\x12\0", 4) + std::string(12, '\0'), "little-endian"},
      {"long.petsc",
       std::string(4, '\0') + std::string("\0\x12\x7b\x50", 4) + std::string(24, '\0'),
       sizeof(PetscInt) == 4 ? "64-bit indices" : "a matrix without rows"},
  };
  for (const auto& [name, text, message] : cases) {
    const std::string error = errorReading(writeFile(name, text));
    EXPECT_TRUE(contains(error, name) && contains(error, message)) << name << ": " << error;
  }
  EXPECT_TRUE(contains(errorReading(SQUEAL_OUTPUT_DIR "/nowhere.mtx"), "there is no such file"));
  EXPECT_TRUE(contains(errorReading(SQUEAL_OUTPUT_DIR "/empty.mtx/within.mtx"), "Not a directory"));
  EXPECT_TRUE(contains(errorReading(SQUEAL_OUTPUT_DIR), "a folder, not a file"));
  EXPECT_TRUE(contains(errorReading("/dev/zero"), "not a regular file"));
  // A name within a file that has none is not passed over.
  EXPECT_TRUE(contains(errorReading(writeFile("single.mtx", size2 + "1\n1 1 1\n"), "k"),
                       "without named objects such as 'k'"));
}

TEST(MatrixFiles, NormsThatOverflowAreSaid) {
  EXPECT_TRUE(contains(errorReading(writeFile("squares.mtx", size2 + "1\n1 1 1e200\n")),
                       "their squares overflow"));
}

TEST(MatrixFiles, LackOfMemoryIsSaidInWords) {
  EXPECT_EQ(
      errorOf([] { onFirstRank(PETSC_COMM_WORLD, "file: ", [] { throw std::bad_alloc(); }); }),
      "file: not enough memory");
}

}  // namespace
}  // namespace squeal::test
