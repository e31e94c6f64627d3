// Values of several members on all ranks.
#include "base/checkpoint/broadcast.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <string>
#include <vector>

namespace squeal {
namespace {

struct Part {
  double x = 0;
  std::string name;
};

struct Whole {
  std::vector<Part> parts;
  std::vector<double> numbers;
  int count = 0;
};

void fields(checkpoint::Stream& stream, Part& part) {
  auto& [x, name] = part;
  stream(x, name);
}

void fields(checkpoint::Stream& stream, Whole& whole) {
  auto& [parts, numbers, count] = whole;
  stream(parts, numbers, count);
}

TEST(Broadcast, SetsAllMembersToThoseOfTheRoot) {
  const int rank = mpi::rank(PETSC_COMM_WORLD), root = mpi::size(PETSC_COMM_WORLD) - 1;
  Whole whole{.parts = {{7, "old"}}, .numbers = {1}, .count = rank};
  if (rank == root) whole = {.parts = {{1, "first"}, {2, ""}}, .numbers = {}, .count = 3};
  checkpoint::broadcast(PETSC_COMM_WORLD, whole, root);
  ASSERT_EQ(whole.parts.size(), 2u);
  EXPECT_EQ(whole.parts[0].x, 1);
  EXPECT_EQ(whole.parts[0].name, "first");
  EXPECT_EQ(whole.parts[1].x, 2);
  EXPECT_EQ(whole.parts[1].name, "");
  EXPECT_TRUE(whole.numbers.empty());
  EXPECT_EQ(whole.count, 3);
}

}  // namespace
}  // namespace squeal
