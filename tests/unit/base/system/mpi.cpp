// SPDX-License-Identifier: BSD-2-Clause
// Collective operations on values and lists: closed forms in the number of ranks.
#include "base/system/mpi.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <cmath>

#include "base/petsc/log_events.hpp"
#include "base/system/concatenation.hpp"

namespace squeal {
namespace {

// Integers, and halves of them, have no round-off: all sums are exact.
TEST(Mpi, Reductions) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const int rank = mpi::rank(comm), ranks = mpi::size(comm);
  EXPECT_EQ(mpi::sum(comm, rank + 1), ranks * (ranks + 1) / 2);
  EXPECT_EQ(mpi::max(comm, rank + 0.5), ranks - 0.5);
  EXPECT_EQ(mpi::min(comm, std::int64_t(rank)), 0);
  EXPECT_EQ(mpi::sumBefore(comm, PetscInt(rank + 1)), rank * (rank + 1) / 2);
  EXPECT_EQ(mpi::sumBefore(comm, 3.0), 3.0 * rank);
  EXPECT_TRUE(mpi::any(comm, rank == ranks - 1));
  EXPECT_EQ(mpi::all(comm, rank == 0), ranks == 1);
  std::vector<double> values{1.0, double(rank), 0.5};
  mpi::reduce<double>(comm, values, MPI_SUM);
  EXPECT_EQ(values, (std::vector<double>{double(ranks), ranks * (ranks - 1) / 2.0, ranks / 2.0}));
}

// The terms are not representable, so the order of a sum matters; all ranks get the same bits.
TEST(Mpi, SumsAreAlikeOnAllRanks) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  std::vector<double> sums;
  for (int i = 0; i < 1000; ++i) sums.push_back(std::sin(1 + i + 7 * mpi::rank(comm)));
  mpi::sumAlike(comm, sums);
  for (const double sum : sums) {
    EXPECT_EQ(mpi::min(comm, sum), sum);
    EXPECT_EQ(mpi::max(comm, sum), sum);
  }
}

// The lowest rank of those with an extreme value.
TEST(Mpi, ExtremesAreLocated) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const int rank = mpi::rank(comm), ranks = mpi::size(comm);
  const auto most = mpi::maxLocated(comm, 2.0 * rank), least = mpi::minLocated(comm, -2.0 * rank),
             equal = mpi::maxLocated(comm, INFINITY);
  EXPECT_EQ(most.value, 2.0 * (ranks - 1));
  EXPECT_EQ(most.rank, ranks - 1);
  EXPECT_EQ(least.value, -2.0 * (ranks - 1));
  EXPECT_EQ(least.rank, ranks - 1);
  EXPECT_EQ(equal.value, INFINITY);
  EXPECT_EQ(equal.rank, 0);
}

TEST(Mpi, Broadcasts) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const int rank = mpi::rank(comm), last = mpi::size(comm) - 1;
  double value = rank;
  mpi::broadcast(comm, value, last);
  EXPECT_EQ(value, last);
  std::vector<int> list(rank, rank);  // another length on each rank
  mpi::broadcast(comm, list, last);
  EXPECT_EQ(list, std::vector<int>(last, last));
  std::vector<double> entries(3, rank);
  mpi::broadcastEntries<double>(comm, entries, last);
  EXPECT_EQ(entries, std::vector<double>(3, last));
  std::string text(rank, 'x');
  mpi::broadcast(comm, text, last);
  EXPECT_EQ(text, std::string(last, 'x'));
}

TEST(Concatenation, IsInTheOrderOfTheRanks) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const int rank = mpi::rank(comm), ranks = mpi::size(comm);
  const std::vector<PetscInt> own(rank + 1, rank);
  std::vector<PetscInt> all;
  for (int r = 0; r < ranks; ++r) all.insert(all.end(), r + 1, r);
  EXPECT_EQ(concatenated(comm, own), all);
  const auto onFirst = concatenatedOnFirst<PetscInt>(comm, own);
  EXPECT_EQ(onFirst, rank == 0 ? all : std::vector<PetscInt>{});
}

// One sum and one broadcast; none on a communicator with one rank.
TEST(Mpi, ReductionsAreCounted) {
  const double before = trafficSoFar().reductions;
  double value = mpi::sum(PETSC_COMM_WORLD, 1.0);
  mpi::broadcast(PETSC_COMM_WORLD, value);
  mpi::broadcast(PETSC_COMM_SELF, value);
  EXPECT_EQ(trafficSoFar().reductions - before, mpi::size(PETSC_COMM_WORLD) > 1 ? 2 : 0);
}

}  // namespace
}  // namespace squeal
