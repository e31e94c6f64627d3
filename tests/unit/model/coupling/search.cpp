// SPDX-License-Identifier: BSD-2-Clause
// The search for nearby faces: against comparison of all pairs, whatever the number of ranks; who
// receives what; how long it takes.
#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "model/coupling/search.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/random_faces.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using coupling::Box;
using coupling::boxOf;
using coupling::Candidates;
using coupling::candidates;
using mortar::Face;
using test::randomFaces;
using test::rankOf;
using test::sizeOf;
using test::total;

bool touch(const Box& a, const Box& b, double distance = 0) {
  for (std::size_t d = 0; d < 3; ++d)
    if (a.low[d] - distance > b.high[d] || b.low[d] > a.high[d] + distance) return false;
  return true;
}

std::size_t numberOf(const Face& face) { return static_cast<std::size_t>(face.nodes.at(0) / 10); }

void expectEqual(const Face& a, const Face& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.parts, b.parts);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.sign, b.sign);
  EXPECT_EQ(a.body, b.body);
}

// Neither the faces nor their order depend on which rank has what.
TEST(Search, FindsWhatComparisonOfAllPairsFinds) {
  const auto slaves = randomFaces(1, 350), masters = randomFaces(2, 420);
  std::vector<Face> mySlaves, myMasters;
  std::vector<std::size_t> mine;
  std::vector<double> distances;
  for (std::size_t i = 0; i < slaves.size(); ++i)
    if (static_cast<int>(i / 10) % sizeOf() == rankOf()) {
      mine.push_back(i);
      mySlaves.push_back(slaves[i]);
      distances.push_back(0.01 * static_cast<double>(i % 4));
    }
  for (std::size_t i = 0; i < masters.size(); ++i)
    if (static_cast<int>(i) % sizeOf() == rankOf()) myMasters.push_back(masters[i]);
  const Candidates found = candidates(PETSC_COMM_WORLD, mySlaves, myMasters, distances);
  EXPECT_EQ(found.ofSlave.size(), mySlaves.size());
  std::set<std::size_t> needed;
  double pairs = 0;
  for (std::size_t s = 0; s < mySlaves.size(); ++s) {
    std::vector<std::size_t> expected;
    for (std::size_t m = 0; m < masters.size(); ++m)
      if (touch(boxOf(slaves[mine[s]]), boxOf(masters[m]), distances[s])) expected.push_back(m);
    std::sort(expected.begin(), expected.end(),
              [&](std::size_t a, std::size_t b) { return masters[a].points < masters[b].points; });
    std::vector<std::size_t> numbers;
    for (std::size_t c : found.ofSlave.at(s)) numbers.push_back(numberOf(found.masters.at(c)));
    EXPECT_EQ(numbers, expected) << "slave " << mine[s];
    needed.insert(expected.begin(), expected.end());
    pairs += static_cast<double>(expected.size());
  }
  EXPECT_EQ(found.masters.size(), needed.size());  // each once, and none in vain
  for (const auto& face : found.masters) expectEqual(face, masters.at(numberOf(face)));
  pairs = total(pairs);
  EXPECT_GT(pairs, 350);  // the boxes are large enough for the test to mean something
  test::print("%g pairs of 350 x 420\n", pairs);
}

// A rank may have no slaves, no masters or neither.
TEST(Search, RanksWithoutFaces) {
  const auto faces = randomFaces(3, 7);
  const std::vector<Face> none;
  const int last = sizeOf() - 1;
  const std::vector<double> distances(faces.size(), 0.0);
  const auto empty = candidates(PETSC_COMM_WORLD, none, none, {});
  EXPECT_TRUE(empty.masters.empty() && empty.ofSlave.empty());
  const auto noSlaves = candidates(PETSC_COMM_WORLD, none, faces, {});
  EXPECT_TRUE(noSlaves.masters.empty() && noSlaves.ofSlave.empty());
  EXPECT_EQ(noSlaves.received, 0u);
  const auto noMasters = candidates(PETSC_COMM_WORLD, faces, none, distances);
  EXPECT_TRUE(noMasters.masters.empty());
  EXPECT_EQ(noMasters.ofSlave, std::vector<std::vector<std::size_t>>(faces.size()));
  // Slaves on the first rank, the same faces as masters on the last.
  const bool slave = rankOf() == 0;
  const auto apart =
      candidates(PETSC_COMM_WORLD, slave ? faces : none, rankOf() == last ? faces : none,
                 slave ? std::span(distances) : std::span<const double>());
  EXPECT_EQ(apart.masters.size(), slave ? faces.size() : 0u);
  EXPECT_EQ(apart.received, slave && last > 0 ? faces.size() : 0u);
  for (std::size_t s = 0; s < apart.ofSlave.size(); ++s) {
    std::set<std::size_t> numbers;
    for (std::size_t c : apart.ofSlave[s]) numbers.insert(numberOf(apart.masters[c]));
    EXPECT_TRUE(numbers.count(s)) << "a face touches itself";
  }
}

/// A quadrilateral of a plane grid of squares.
Face square(double x, double y, double z, double size) {
  Face face;
  face.type = 3;
  face.points = {{x, y, z}, {x + size, y, z}, {x + size, y + size, z}, {x, y + size, z}};
  face.nodes = {0, 1, 2, 3};
  face.parts = {0, 0, 0, 0};
  return face;
}

// Each rank has slaves at four places that together surround all masters. Only faces at these
// places come from other ranks, although one box around the slaves would touch all.
TEST(Search, FarFacesStayWhereTheyAre) {
  constexpr int cells = 60;
  constexpr double far = cells - 4;
  const double shift = 5.0 * rankOf() + 0.5;
  const std::pair<double, double> places[] = {
      {shift, 0}, {far, shift}, {0, far - shift}, {far - shift, far}};
  std::vector<Face> slaves, masters;
  std::vector<Box> boxes;
  for (const auto& [x, y] : places) {
    boxes.push_back({{x, y, 0}, {x + 3, y + 3, 0}});
    for (int i = 0; i < 9; ++i) slaves.push_back(square(x + i % 3, y + i / 3, 0, 1));
  }
  double foreign = 0, near = 0, around = 0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Face face = square(i, j, 0, 1);
      if ((i + j) % sizeOf() == rankOf()) {
        masters.push_back(face);
        continue;
      }
      ++foreign;
      const auto touching = [&](const Box& box) { return touch(box, boxOf(face)); };
      near += std::any_of(boxes.begin(), boxes.end(), touching);
      around += touching({{0, 0, 0}, {far + 3, far + 3, 0}});
    }
  const std::vector<double> distances(slaves.size(), 1e-6);
  const auto found = candidates(PETSC_COMM_WORLD, slaves, masters, distances);
  double needed = 0;
  for (const auto& face : found.masters)
    needed += static_cast<int>(face.points[0][0] + face.points[0][1]) % sizeOf() != rankOf();
  EXPECT_EQ(static_cast<double>(found.received), near);
  EXPECT_EQ(needed, near);
  if (sizeOf() > 1) {
    EXPECT_GT(near, 0);
    EXPECT_LT(near, 0.05 * foreign);
    EXPECT_GT(around, 0.9 * foreign);
  }
  test::print("%zu of %g faces of other ranks received; one box would touch %g\n", found.received,
              foreign, around);
}

/// A plate of n × n slaves above one of masters that is shifted by half a face. Masters and slaves
/// of a rank are at opposite ends. Returns the number of candidates of all slaves.
double searchPlates(int n) {
  using Clock = std::chrono::steady_clock;
  std::vector<Face> slaves, masters;
  const int begin = n * rankOf() / sizeOf(), end = n * (rankOf() + 1) / sizeOf();
  for (int row = begin; row < end; ++row)
    for (int i = 0; i < n; ++i) {
      slaves.push_back(square(i + 0.5, row + 0.5, 0.1, 1));
      masters.push_back(square(i, n - 1 - row, 0, 1));
    }
  const std::vector<double> distances(slaves.size(), 0.2);
  const auto start = Clock::now();
  const auto found = candidates(PETSC_COMM_WORLD, slaves, masters, distances);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  double count = 0;
  for (const auto& list : found.ofSlave) count += static_cast<double>(list.size());
  test::print("%d faces on each side: %.3f s, %zu received here\n", n * n, seconds, found.received);
  return total(count);
}

// Per direction, face i of a row touches the faces i and i + 1 of the other side, the last but one.
TEST(Search, PlatesOfManyFaces) {
  for (const double n : {100, 316})
    EXPECT_EQ(searchPlates(static_cast<int>(n)), (2 * n - 1) * (2 * n - 1));
}

}  // namespace
}  // namespace squeal
