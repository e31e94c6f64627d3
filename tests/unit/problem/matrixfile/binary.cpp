// SPDX-License-Identifier: BSD-2-Clause
// PETSc's binary format and HDF5: whole files, and those whose parts do not fit together.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <tuple>
#include <type_traits>

#include "problem/matrices/read.hpp"
#include "problem/matrixfile/bytes.hpp"
#include "problem/matrixfile/hdf5.hpp"
#include "problem/matrixfile/matrix_market.hpp"
#include "problem/matrixfile/petsc_binary.hpp"
#include "support/problem/hdf5_writer.hpp"
#include "support/problem/matrix_files.hpp"

namespace squeal::test {
namespace {

// --- PETSc ---

template <class Number>
std::string bigEndian(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  if (matrixfile::littleEndian) std::ranges::reverse(bytes);
  return bytes;
}

/// A file with indices of another width than this build's can be written too.
template <class Index>
struct PetscOf {
  Index rows = 2, columns = 2, entries = 3;
  std::vector<Index> lengths{1, 2}, index{0, 0, 1};
  std::vector<double> values{2, 1, 3};

  std::string bytes() const {
    std::string text =
        bigEndian(Index{1211216}) + bigEndian(rows) + bigEndian(columns) + bigEndian(entries);
    for (const auto& list : {lengths, index})
      for (const auto number : list) text += bigEndian(number);
    for (const double value : values) text += bigEndian(value);
    return text;
  }
};

using Petsc = PetscOf<PetscInt>;

TEST(PetscBinary, Sample) {
  const OwnedMat matrix =
      matrices::read(PETSC_COMM_WORLD, written("from.mtx", [](const auto& path) {
                       matrixfile::writeMatrixMarket(path, sampleEntries());
                     }));
  const std::string path = SQUEAL_OUTPUT_DIR "/sample.petsc";
  OwnedViewer viewer;
  check(PetscViewerBinaryOpen(PETSC_COMM_WORLD, path.c_str(), FILE_MODE_WRITE, viewer.out()));
  check(MatView(matrix, viewer));
  viewer = {};
  check(MPI_Barrier(PETSC_COMM_WORLD));
  expectSample(path);
  const auto read = [](const auto& from) { matrixfile::requirePetscBinary(from); };
  EXPECT_EQ(cutsThatPass("cut.petsc", bytesOf(path), read), std::vector<std::size_t>{});
}

TEST(PetscBinary, ColumnsInAnyOrder) {
  const std::vector<double> byColumns{2, 1, 0, 3};
  EXPECT_EQ(valuesRead(writeFile("sorted.petsc", Petsc{}.bytes())), byColumns);
  EXPECT_EQ(
      valuesRead(writeFile("unsorted.petsc", Petsc{2, 2, 3, {1, 2}, {0, 1, 0}, {2, 3, 1}}.bytes())),
      byColumns);
}

TEST(PetscBinary, WhatMatLoadWouldMisreadIsNamed) {
  const std::string sound = Petsc{}.bytes();
  const std::vector<std::array<std::string, 3>> cases{
      {"negative", Petsc{2, 2, 3, {1, 2}, {0, -5, 1}, {2, 1, 3}}.bytes(),
       "row 1 (counted from 0) has an entry in column -5 of 2"},
      {"beyond", Petsc{2, 2, 3, {1, 2}, {7, 0, 1}, {2, 1, 3}}.bytes(),
       "row 0 (counted from 0) has an entry in column 7 of 2"},
      {"last", Petsc{2, 2, 3, {1, 2}, {0, 0, 2}, {2, 1, 3}}.bytes(),
       "row 1 (counted from 0) has an entry in column 2 of 2"},
      {"lengths", Petsc{2, 2, 2, {3, -1}, {0, 1}, {1, 1}}.bytes(),
       "row 0 (counted from 0) has 3 entries in 2 columns"},
      {"length", Petsc{2, 2, 1, {2, -1}, {0}, {1}}.bytes(),
       "row 0 (counted from 0) has more entries than the header announces"},
      {"minus", Petsc{2, 2, 1, {-1, 2}, {0}, {1}}.bytes(), "row 0 (counted from 0) has -1 entries"},
      {"sum", Petsc{2, 2, 3, {1, 1}, {0, 0, 1}, {2, 1, 3}}.bytes(),
       "the rows have 2 entries, the header announces 3"},
      {"twice", Petsc{2, 2, 3, {1, 2}, {0, 1, 1}, {2, 1, 3}}.bytes(),
       "row 1 (counted from 0) has two entries in column 1"},
      {"nan", Petsc{2, 2, 3, {1, 2}, {0, 0, 1}, {2, std::nan(""), 3}}.bytes(),
       "entry 2 of 3 is not a finite number"},
      {"wide", Petsc{2, 3, 3, {1, 2}, {0, 0, 1}, {2, 1, 3}}.bytes(),
       "2 rows and 3 columns, not square"},
      {"dense", Petsc{2, 2, -1, {}, {}, {1, 2, 3, 4}}.bytes(), "a dense matrix"},
      {"rows", Petsc{-2, 2, 0, {}, {}, {}}.bytes(), "the header announces -2 rows"},
      {"huge", Petsc{2000000000, 2000000000, 2000000000, {}, {}, {}}.bytes(),
       std::to_string(4 * sizeof(PetscInt)) + " bytes, but a real matrix of 2000000000 rows"},
      {"long", sound + "1234", "truncated, or of another PETSc configuration"},
      {"head", sound.substr(0, 12), "truncated"},
  };
  for (const auto& [name, bytes, message] : cases) {
    const std::string error = errorReading(writeFile(name + ".petsc", bytes));
    EXPECT_TRUE(contains(error, name + ".petsc: ") && contains(error, message))
        << name << ": " << error;
  }
}

TEST(PetscBinary, OtherIndicesAreRefused) {
  using Other = std::conditional_t<sizeof(PetscInt) == 4, std::int64_t, std::int32_t>;
  const std::string error = errorReading(writeFile("other.petsc", PetscOf<Other>{}.bytes()));
  EXPECT_TRUE(contains(error, sizeof(PetscInt) == 4
                                  ? "with 64-bit indices: write it with 32-bit indices"
                                  : "with 32-bit indices: write it with 64-bit indices"))
      << error;
}

// PETSc takes options from a file beside the one it reads: nobody gave them.
TEST(PetscBinary, OptionsBesideTheFileAreNotTaken) {
  clearOptions();
  const std::string path = writeFile("beside.petsc", Petsc{}.bytes());
  writeFile("beside.petsc.info", "-flutter_friction 7\n");
  valuesRead(path);
  PetscBool taken = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, nullptr, "-flutter_friction", &taken));
  EXPECT_FALSE(taken);
}

// --- HDF5 ---

/// A compressed matrix as SciPy's users write it, [[2, 0], [1, 3]] by rows.
struct Group {
  std::vector<long long> begin{0, 1, 3}, index{0, 0, 1};
  std::vector<double> data{2, 1, 3};
  std::string format = "csr";  ///< empty: no attribute says it

  void operator()(const Hdf5File& file) const {
    file.group("k");
    file.dataset("k/indptr", H5T_NATIVE_LLONG, begin.data(), {begin.size()});
    file.dataset("k/indices", H5T_NATIVE_LLONG, index.data(), {index.size()});
    file.dataset("k/data", H5T_NATIVE_DOUBLE, data.data(), {data.size()});
    if (!format.empty()) file.text("k", "format", format);
  }
};

void writeGroup(const Hdf5File& file, const std::string& name, bool byColumns) {
  const Lists lists(byColumns);
  file.group(name);
  file.dataset(name + "/data", H5T_NATIVE_DOUBLE, lists.data.data(), {lists.data.size()});
  file.dataset(name + "/indices", H5T_NATIVE_UINT, lists.indices.data(), {lists.indices.size()});
  file.dataset(name + "/indptr", H5T_NATIVE_UINT, lists.begin.data(), {lists.begin.size()}, {2});
  file.text(name, "encoding-type", byColumns ? "csc_matrix" : "csr_matrix");  // as anndata does
}

TEST(Hdf5, Sample) {
  const auto path = written("sample.h5", [](const auto& to) {
    const Hdf5File file(to);
    writeGroup(file, "rows", false);
    writeGroup(file, "columns", true);
    file.dataset("full", H5T_NATIVE_DOUBLE, sample.data(), {4, 4});
    file.dataset("chunks", H5T_NATIVE_DOUBLE, sample.data(), {4, 4}, {3, 3});
  });
  expectSample(path, "rows");
  expectSample(path, "columns");
  expectSample(path, "/full");
  expectSample(path, "chunks");
  EXPECT_TRUE(contains(errorReading(path), "several matrices, chunks, columns, full, rows"));
  EXPECT_TRUE(contains(errorReading(path, "other"), "no object 'other'"));
  EXPECT_TRUE(contains(errorReading(path, "rows/data"), "neither"));
  const auto one = written("one.h5", [](const auto& to) { writeGroup(Hdf5File(to), "it", true); });
  expectSample(one);
  const auto read = [](const auto& from) { matrixfile::readHdf5(from, ""); };
  EXPECT_EQ(cutsThatPass("cut.h5", bytesOf(one), read, 97), std::vector<std::size_t>{});
}

TEST(Hdf5, EntriesOfEqualPlaceAreSummed) {
  const auto path = written("twice.h5", [](const auto& to) {
    Group{{0, 2, 4}, {0, 0, 1, 0}, {0.5, 1.5, 3, 1}}(Hdf5File(to));
  });
  EXPECT_EQ(valuesRead(path), (std::vector<double>{2, 1, 0, 3}));
}

// By rows and by columns the same lists are a matrix and its transpose: neither is more likely than
// the other.
TEST(Hdf5, AnUnsaidLayoutIsNoMatrixUnlessItIsSymmetric) {
  const auto unsaid =
      written("unsaid.h5", [](const auto& to) { Group{.format = ""}(Hdf5File(to)); });
  const std::string error = errorReading(unsaid);
  for (const char* word :
       {"unsaid.h5: 'k': ", "by rows or by columns", "'format'", "csr or csc", "not symmetric"})
    EXPECT_TRUE(contains(error, word)) << word << ": " << error;
  // [[2, 1], [1, 3]], the entry above the diagonal in two parts.
  const Group symmetric{{0, 3, 5}, {0, 1, 1, 0, 1}, {2, 0.25, 0.75, 1, 3}, ""};
  const auto same =
      written("unsaid_symmetric.h5", [&](const auto& to) { symmetric(Hdf5File(to)); });
  EXPECT_EQ(valuesRead(same), (std::vector<double>{2, 1, 1, 3}));
}

TEST(Hdf5, TheLayoutMayBeSaidInFourPlaces) {
  // What is read has one column after the other.
  const std::vector<double> byRows{2, 1, 0, 3}, byColumns{2, 0, 1, 3};
  for (const std::string name : {"format", "h5sparse_format", "encoding-type", "dataset"})
    for (const std::string layout : {"csr", "csc"}) {
      const auto path = written("said_" + name + "_" + layout + ".h5", [&](const auto& to) {
        const Hdf5File file(to);
        Group{.format = ""}(file);
        if (name == "dataset")
          file.textDataset("k/format", layout);
        else
          file.text("k", name, layout + (name == "encoding-type" ? "_matrix" : ""));
      });
      EXPECT_EQ(valuesRead(path), layout == "csr" ? byRows : byColumns) << name << " " << layout;
    }
}

struct Damaged {
  std::string name;
  std::function<void(const Hdf5File&)> write;
  std::string message;
};

void expectNamed(const std::vector<Damaged>& cases) {
  for (const auto& [name, write, message] : cases) {
    const auto path =
        written(name + ".h5", [&, &write = write](const auto& to) { write(Hdf5File(to)); });
    const std::string error = errorReading(path);
    EXPECT_TRUE(contains(error, name + ".h5: ") && contains(error, message))
        << name << ": " << error;
  }
}

TEST(Hdf5, ListsThatDoNotFitTogether) {
  expectNamed({
      {"empty", Group{{}, {}, {}}, "indptr is empty"},
      {"no_rows", Group{{0}, {}, {}}, "a matrix without rows"},
      {"first", Group{{1, 1, 3}, {0, 0, 1}, {2, 1, 3}}, "indptr begins with 1, not with 0"},
      {"falls", Group{{0, 4, 3}, {0, 0, 1}, {2, 1, 3}}, "indptr falls from 4 to 3"},
      {"below", Group{{0, -1, 3}, {0, 0, 1}, {2, 1, 3}}, "indptr falls from 0 to -1"},
      {"last", Group{{0, 1, 2}, {0, 0, 1}, {2, 1, 3}},
       "indptr ends with 2, but indices has 3 numbers and data has 3"},
      {"beyond", Group{{0, 1, 4000000000}, {0, 0, 1}, {2, 1, 3}}, "indptr ends with 4000000000"},
      {"indices", Group{{0, 1, 3}, {0, 0}, {2, 1, 3}}, "indices has 2 numbers and data has 3"},
      {"data", Group{{0, 1, 3}, {0, 0, 1}, {2, 1}}, "indices has 3 numbers and data has 2"},
      {"negative", Group{{0, 1, 3}, {0, -5, 1}, {2, 1, 3}},
       "row 1 and column -5 of a matrix of 2 x 2"},
      {"outside", Group{{0, 1, 3}, {0, 4294967296, 1}, {2, 1, 3}},
       "row 1 and column 4294967296 of a matrix of 2 x 2"},
      {"infinite", Group{{0, 1, 3}, {0, 0, 1}, {2, HUGE_VAL, 3}},
       "row 1 and column 0 (counted from 0) is not a finite number"},
  });
}

TEST(Hdf5, OtherTypesAndKinds) {
  const std::vector<double> numbers{0, 1, 3};
  const hid_t pair = H5Tcreate(H5T_COMPOUND, 16);
  H5Tinsert(pair, "r", 0, H5T_NATIVE_DOUBLE);
  H5Tinsert(pair, "i", 8, H5T_NATIVE_DOUBLE);
  const std::vector<double> pairs(8, 1);
  const long long three = 3;
  expectNamed({
      {"real_indices",
       [&](const Hdf5File& file) {
         file.group("k");
         for (const std::string name : {"indptr", "indices", "data"})
           file.dataset("k/" + name, H5T_NATIVE_DOUBLE, numbers.data(), {3});
       },
       "dataset 'indptr': integers are expected, but it contains reals"},
      {"complex",
       [&](const Hdf5File& file) {
         file.group("k");
         file.dataset("k/indptr", H5T_NATIVE_LLONG, Group{}.begin.data(), {3});
         file.dataset("k/indices", H5T_NATIVE_LLONG, Group{}.index.data(), {3});
         file.dataset("k/data", pair, pairs.data(), {3});
       },
       "dataset 'data': real numbers are expected, but it contains a compound type, such as "
       "complex numbers"},
      {"complex_table",
       [&](const Hdf5File& file) {
         file.dataset("k", pair, pairs.data(), {2, 2});
       },
       "contains no matrix"},
      {"two_dimensions",
       [&](const Hdf5File& file) {
         file.group("k");
         for (const std::string name : {"indptr", "indices", "data"})
           file.dataset("k/" + name, H5T_NATIVE_LLONG, pairs.data(), {3, 1});
       },
       "dataset 'indptr': 1 dimensions are expected, but it has 2"},
      {"blocks", Group{.format = "bsr"}, "the format 'bsr' is not supported"},
      {"contradiction",
       [&](const Hdf5File& file) { Group{}(file), file.text("k", "encoding-type", "csc_matrix"); },
       "both csr and csc"},
      {"shape",
       [&](const Hdf5File& file) {
         Group{}(file);
         const long long shape[] = {three, three};
         file.dataset("k/shape", H5T_NATIVE_LLONG, shape, {2});
       },
       "indptr has 3 numbers where a matrix of 3 rows takes 4"},
      {"wide",
       [&](const Hdf5File& file) {
         file.dataset("k", H5T_NATIVE_DOUBLE, pairs.data(), {2, 4});
       },
       "2 rows and 4 columns, not square"},
  });
  H5Tclose(pair);
}

// HDF5 reads zeros where nothing was written.
TEST(Hdf5, WhatWasNeverWritten) {
  const double one = 1;
  const auto around = [](const std::function<void(const Hdf5File&)>& data) {
    return [data](const Hdf5File& file) {
      file.group("k");
      file.dataset("k/indptr", H5T_NATIVE_LLONG, Group{}.begin.data(), {3});
      file.dataset("k/indices", H5T_NATIVE_LLONG, Group{}.index.data(), {3});
      data(file);
    };
  };
  expectNamed({
      {"unwritten",
       around([](const auto& file) { file.dataset("k/data", H5T_NATIVE_DOUBLE, nullptr, {3}); }),
       "dataset 'data': the file contains 0 bytes of it, but its size requires 24"},
      {"unwritten_chunk", around([&](const auto& file) {
         file.dataset("k/data", H5T_NATIVE_DOUBLE, nullptr, {3}, {1});
         file.writeFirst("k/data", H5T_NATIVE_DOUBLE, &one, 1);
       }),
       "dataset 'data': 1 of its 3 chunks were written"},
      {"huge", around([](const auto& file) {
         file.dataset("k/data", H5T_NATIVE_DOUBLE, nullptr, {2000000000});
       }),
       "the file contains 0 bytes of it, but its size requires 16000000000"},
      {"huge_chunks", around([&](const auto& file) {
         file.dataset("k/data", H5T_NATIVE_DOUBLE, nullptr, {2000000000}, {1000});
         file.writeFirst("k/data", H5T_NATIVE_DOUBLE, &one, 1);
       }),
       "1 of its 2000000 chunks were written"},
      {"large_table",
       [](const auto& file) {
         file.dataset("k", H5T_NATIVE_DOUBLE, nullptr, {100000, 100000});
       },
       "the file contains 0 bytes of it, but its size requires 80000000000"},
      {"elsewhere", around([](const auto& file) {
         file.dataset("k/data", H5T_NATIVE_DOUBLE, nullptr, {3}, {}, "/dev/null");
       }),
       "its values are in other files"},
  });
}

// The heap that holds the names of the root's objects, without an address or of another size: the
// HDF5 library reads beyond its arrays, or asks for the memory that the word says.
TEST(Hdf5, DamageThatTheLibraryDoesNotSurvive) {
  const auto path = written("heap.h5", [](const auto& to) { Group{}(Hdf5File(to)); });
  const std::string bytes = bytesOf(path);
  const std::size_t heap = bytes.find("HEAP");
  ASSERT_NE(heap, std::string::npos);
  for (const auto& [name, at, word] :
       {std::tuple{"no_address.h5", 24, std::string(8, '\xff')},
        {"size.h5", 8, std::string("\x58\0\0\0\0\0\0\x5a", 8)},
        {"size_32.h5", 8, std::string("\xfb\xff\xff\xff\0\0\0\0", 8)}}) {
    std::string damaged = bytes;
    damaged.replace(heap + static_cast<std::size_t>(at), 8, word);
    const std::string error = errorReading(writeFile(name, damaged));
    EXPECT_TRUE(contains(error, std::string(name) + ": ")) << name << ": " << error;
    EXPECT_FALSE(contains(error, "std::") || contains(error, "\n")) << error;
  }
}

}  // namespace
}  // namespace squeal::test
