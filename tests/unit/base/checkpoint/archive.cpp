// SPDX-License-Identifier: BSD-2-Clause
// A checkpoint is read back as it was written, on any number of ranks; a damaged one is rejected.
#include "base/checkpoint/archive.hpp"

#include <fstream>

#include "algebra/linalg/serialization.hpp"
#include "base/checkpoint/checkpoint.hpp"
#include "base/options/settings.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/regular_file.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/ranks.hpp"
#include "support/harness/scratch_folder.hpp"

namespace squeal::checkpoint {
namespace {

namespace fs = std::filesystem;

int rankHere() { return mpi::rank(PETSC_COMM_WORLD); }

/// The folder of a checkpoint. Its parent is removed with it.
fs::path folder(const std::string& name) {
  return fs::path(SQUEAL_OUTPUT_DIR) /
         ("checkpoint_" + name + "_" + std::to_string(mpi::size(PETSC_COMM_WORLD))) / "entries";
}

/// Settings that make every call an entry.
Settings everyEntry(bool resume) { return {.interval = 0, .resume = resume}; }

/// Writes one entry, whose parts differ from rank to rank.
void write(Checkpoint& checkpoint, double first) {
  const int rank = rankHere();
  Archive archive(PETSC_COMM_WORLD);
  std::string text = "τ < 1";
  std::vector<std::vector<int>> nested{{1, 2}, {}, {3}};
  std::optional<double> none, some = 2.5;
  linalg::DensePair pair{{1, 2}, {{3, 4}}, {}};
  std::vector<std::pair<int, std::string>> pairs{{7, "a"}, {8, ""}};
  archive.common(text, nested, none, some, pair, pairs);
  linalg::DenseMatrix matrix(2 + rank, 3), large(100 * rank, 5);
  matrix(1, 2) = first + rank;
  if (rank > 0) large(99, 4) = rank;
  archive.own(matrix);
  linalg::borrow(archive.own, large);
  OwnedVec vector, null;
  VecCreate(PETSC_COMM_WORLD, vector.out());
  VecSetSizes(vector, 3 * (rank + 1), PETSC_DETERMINE);
  VecSetBlockSize(vector, 3);
  VecSetType(vector, VECSTANDARD);
  VecSet(vector, first);
  archive.vector(vector);
  archive.vector(null);
  checkpoint.write("log", archive);
}

void expectAsWritten(Checkpoint& checkpoint, double first) {
  const int rank = rankHere();
  auto archive = checkpoint.next("log");
  ASSERT_TRUE(archive);
  std::string text;
  std::vector<std::vector<int>> nested{{5}};
  std::optional<double> none = 1, some;
  linalg::DensePair pair;
  std::vector<std::pair<int, std::string>> pairs;
  archive->common(text, nested, none, some, pair, pairs);
  EXPECT_EQ(text, "τ < 1");
  EXPECT_EQ(nested, (std::vector<std::vector<int>>{{1, 2}, {}, {3}}));
  EXPECT_FALSE(none);
  EXPECT_EQ(some, 2.5);
  EXPECT_EQ(pair.s, Complex(1, 2));
  EXPECT_EQ(pair.q, (std::vector<Complex>{{3, 4}}));
  EXPECT_TRUE(pair.left.empty());
  EXPECT_EQ(pairs, (std::vector<std::pair<int, std::string>>{{7, "a"}, {8, ""}}));
  linalg::DenseMatrix matrix, large;
  archive->own(matrix, large);
  EXPECT_EQ(matrix.rows(), 2 + rank);
  EXPECT_EQ(matrix(1, 2), first + rank);
  EXPECT_EQ(large.rows(), 100 * rank);
  EXPECT_EQ(large.columns(), 5);
  if (rank > 0) {
    EXPECT_EQ(large(99, 4), rank);
  }
  OwnedVec vector, null;
  archive->vector(vector);
  archive->vector(null);
  PetscInt blockSize = 0;
  VecGetBlockSize(vector, &blockSize);
  EXPECT_EQ(blockSize, 3);
  const ReadArray entries(vector);
  EXPECT_EQ(entries.size(), 3 * (rank + 1));
  for (const double entry : entries) EXPECT_EQ(entry, first);
  EXPECT_FALSE(null);
}

TEST(Checkpoint, IsReadAsItWasWritten) {
  const fs::path place = folder("read");
  const Identity identity{{"a", "1"}};
  Checkpoint first(PETSC_COMM_WORLD, place, identity, everyEntry(false));
  EXPECT_TRUE(first.due());
  EXPECT_FALSE(first.next("log"));
  write(first, 1);
  write(first, 2);
  Checkpoint second(PETSC_COMM_WORLD, place, identity, everyEntry(true));
  EXPECT_TRUE(second.resumed());
  expectAsWritten(second, 1);
  expectAsWritten(second, 2);
  EXPECT_FALSE(second.next("log"));
  EXPECT_FALSE(second.next("other"));
  write(second, 3);  // after those that it has read
  Checkpoint third(PETSC_COMM_WORLD, place, identity, everyEntry(true));
  for (const double value : {1., 2., 3.}) expectAsWritten(third, value);
  third.remove();
  MPI_Barrier(PETSC_COMM_WORLD);  // rank 0 removes it
  EXPECT_FALSE(fs::exists(place));
}

TEST(Checkpoint, OfAnotherRunIsRefused) {
  const fs::path place = folder("other");
  Checkpoint first(PETSC_COMM_WORLD, place, {{"a", "1"}, {"b", "2"}}, everyEntry(false));
  write(first, 1);
  try {
    Checkpoint(PETSC_COMM_WORLD, place, {{"a", "1"}, {"b", "3"}}, everyEntry(true));
    ADD_FAILURE() << "it is taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("belongs to another run: b was '2' and is '3'"),
              std::string::npos)
        << error.what();
  }
  // A run that does not resume it leaves it there until its own first entry.
  Checkpoint fresh(PETSC_COMM_WORLD, place, {{"a", "1"}, {"b", "3"}}, everyEntry(false));
  EXPECT_FALSE(fresh.next("log"));
  Checkpoint old(PETSC_COMM_WORLD, place, {{"a", "1"}, {"b", "2"}}, everyEntry(true));
  expectAsWritten(old, 1);
  write(fresh, 5);
  Checkpoint again(PETSC_COMM_WORLD, place, {{"a", "1"}, {"b", "3"}}, everyEntry(true));
  expectAsWritten(again, 5);
  EXPECT_FALSE(again.next("log"));
  again.remove();
  MPI_Barrier(PETSC_COMM_WORLD);
}

TEST(Checkpoint, DamageIsFound) {
  const fs::path place = folder("damaged"), file = place / "log_0000.entry";
  const Identity identity{{"a", "1"}};
  Checkpoint first(PETSC_COMM_WORLD, place, identity, everyEntry(false));
  write(first, 1);
  const auto size = fs::file_size(file);
  MPI_Barrier(PETSC_COMM_WORLD);
  // In the mark, the table of the parts, the common part, the part of the last rank, and the last
  // byte.
  for (const double part : {0.0, 0.02, 0.1, 0.9, 1.0}) {
    const auto change = [&] {
      if (rankHere() == 0) {
        std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
        const auto at = std::min<std::uintmax_t>(part * size, size - 1);
        bytes.seekg(at);
        const char before = bytes.get();
        bytes.seekp(at);
        bytes.put(before ^ 4);
      }
      MPI_Barrier(PETSC_COMM_WORLD);
    };
    change();
    Checkpoint second(PETSC_COMM_WORLD, place, identity, everyEntry(true));
    EXPECT_THROW(second.next("log"), Error) << part;
    MPI_Barrier(PETSC_COMM_WORLD);
    change();
  }
  if (rankHere() == 0) fs::resize_file(file, size - 1);
  MPI_Barrier(PETSC_COMM_WORLD);
  Checkpoint cut(PETSC_COMM_WORLD, place, identity, everyEntry(true));
  EXPECT_THROW(cut.next("log"), Error);
  cut.remove();
  MPI_Barrier(PETSC_COMM_WORLD);
}

// What a run leaves that is killed while it writes or opens an entry goes with the checkpoint; a
// file of the user stays.
TEST(Checkpoint, RemainsOfAKilledRunAreRemoved) {
  for (const bool hasOther : {false, true}) {
    const fs::path place = folder("killed");
    Checkpoint checkpoint(PETSC_COMM_WORLD, place, {{"a", "1"}}, everyEntry(false));
    write(checkpoint, 1);
    if (rankHere() == 0) {
      for (const char* name : {"log_0001.entry.partial", "log_0001.entry.partial.locktest.0"})
        std::ofstream(place / name) << "x";
      if (hasOther) std::ofstream(place / "mine.txt") << "x";
    }
    MPI_Barrier(PETSC_COMM_WORLD);
    checkpoint.remove();
    MPI_Barrier(PETSC_COMM_WORLD);
    EXPECT_EQ(fs::exists(place), hasOther);
    EXPECT_FALSE(fs::exists(place / "log_0001.entry.partial.locktest.0"));
    MPI_Barrier(PETSC_COMM_WORLD);
    if (rankHere() == 0) fs::remove_all(place);
    MPI_Barrier(PETSC_COMM_WORLD);
  }
}

TEST(Checkpoint, AFailedWriteDoesNotEndTheRun) {
  const fs::path file = folder("file").parent_path();
  if (rankHere() == 0) std::ofstream(file) << "mine";
  MPI_Barrier(PETSC_COMM_WORLD);
  Checkpoint checkpoint(PETSC_COMM_WORLD, file / "inside", {{"a", "1"}}, everyEntry(false));
  EXPECT_NO_THROW(write(checkpoint, 1));
  EXPECT_FALSE(checkpoint.exists());
  EXPECT_FALSE(checkpoint.due());  // it is disabled
  MPI_Barrier(PETSC_COMM_WORLD);
  if (rankHere() == 0) fs::remove(file);
}

// Regression: a link in the place of the next entry let the run overwrite a foreign file, and a
// pipe blocked it.
TEST(Checkpoint, IsWrittenNeitherThroughALinkNorIntoAPipe) {
  for (const std::string kind : {"a link", "a named pipe", "a folder"}) {
    const test::Folder place;
    const fs::path entries = place.path / "interrupted" / "checkpoint",
                   partial = entries / "log_0001.entry.partial", foreign = place.path / "foreign";
    const Identity identity{{"a", "1"}};
    Checkpoint checkpoint(PETSC_COMM_WORLD, entries, identity, everyEntry(false));
    write(checkpoint, 1);
    EXPECT_TRUE(checkpoint.exists());
    test::plant(kind, partial, foreign);
    EXPECT_NO_THROW(write(checkpoint, 2));
    EXPECT_FALSE(checkpoint.due());  // it is disabled
    for (const bool resumes : {false, true}) {
      const std::string message = test::errorOf(
          [&] { Checkpoint(PETSC_COMM_WORLD, entries, identity, everyEntry(resumes)); });
      EXPECT_EQ(message, "option -checkpoint: invalid file in the checkpoint folder: " +
                             partial.string() + " is " + kind + ", not a regular file");
    }
    EXPECT_EQ(contentOfRegular(foreign), "foreign");
    MPI_Barrier(PETSC_COMM_WORLD);
  }
}

}  // namespace
}  // namespace squeal::checkpoint
