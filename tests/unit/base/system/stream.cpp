// SPDX-License-Identifier: BSD-2-Clause
// Values are read back as they were written, and broadcast from any rank; bytes that end too early
// are rejected.
#include "base/system/stream.hpp"

#include "base/petsc/object.hpp"
#include "base/petsc/owned.hpp"
#include "support/harness/ranks.hpp"

namespace squeal {
namespace shapes {

enum class Kind { none, round, square };

struct Edge {
  int from = 0, to = 0;
  bool operator==(const Edge&) const = default;
};

/// A type of several members, some of which are such types.
struct Shape {
  std::string name;
  Kind kind = Kind::none;
  std::vector<Edge> edges;
  std::optional<std::vector<double>> weights;
  std::vector<Shape> parts = {};
  bool operator==(const Shape&) const = default;
};

void fields(Stream& stream, Shape& shape) {
  stream(shape.name, shape.kind, shape.edges, shape.weights, shape.parts);
}

}  // namespace shapes

namespace {

using shapes::Shape;

Shape sample() {
  return {.name = "τ \"1\"\n",
          .kind = shapes::Kind::square,
          .edges = {{1, 2}, {2, 3}},
          .weights = std::vector{0.1, -0.0, 1e300},
          .parts = {{.name = "", .edges = {{4, 5}}, .weights = std::vector<double>{}}, Shape()}};
}

std::vector<char> bytesOf(Shape shape) {
  Stream stream;
  stream(shape);
  return stream.bytes();
}

TEST(Stream, ReadsWhatItHasWritten) {
  Stream written;
  std::vector<std::vector<std::string>> nested{{"a", ""}, {}, {"b"}};
  std::optional<double> none, some = 2.5;
  std::map<std::string, std::vector<int>> map{{"x", {1, 2}}, {"", {}}};
  std::pair<int, std::string> pair{7, "c"};
  Shape shape = sample();
  written(nested, none, some, map, pair, shape);
  EXPECT_FALSE(written.reads());

  Stream read(written.bytes());
  EXPECT_TRUE(read.reads());
  std::vector<std::vector<std::string>> nestedRead{{"z"}};
  std::optional<double> noneRead = 1, someRead;
  std::map<std::string, std::vector<int>> mapRead{{"y", {3}}};
  std::pair<int, std::string> pairRead;
  Shape shapeRead;
  read(nestedRead, noneRead, someRead, mapRead, pairRead);
  EXPECT_FALSE(read.atEnd());
  read(shapeRead);
  EXPECT_TRUE(read.atEnd());
  EXPECT_EQ(nestedRead, nested);
  EXPECT_EQ(noneRead, none);
  EXPECT_EQ(someRead, some);
  EXPECT_EQ(mapRead, map);
  EXPECT_EQ(pairRead, pair);
  EXPECT_EQ(shapeRead, shape);
}

TEST(Stream, BorrowedBytesKeepTheirPlace) {
  const auto owner = std::make_shared<std::vector<char>>(std::vector{'b', 'c'});
  char first = 'a', last = 'd';
  Stream stream;
  stream(first);
  stream.borrow(*owner, owner);
  EXPECT_EQ(owner.use_count(), 2);
  stream(last);
  EXPECT_EQ(stream.bytes(), (std::vector{'a', 'b', 'c', 'd'}));
}

// A damaged count must not allocate more memory than there are bytes.
TEST(Stream, BytesThatEndTooEarlyAreRejected) {
  const auto whole = bytesOf(sample());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    Stream stream({whole.begin(), whole.begin() + length}, "the message is cut short");
    Shape shape;
    try {
      stream(shape);
      ADD_FAILURE() << length << " bytes are accepted";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "the message is cut short");
    }
  }
  std::vector<char> count(sizeof(std::size_t), '\x7f');
  std::vector<double> values;
  std::string text;
  EXPECT_THROW(Stream{count}(values), Error);
  EXPECT_THROW(Stream{count}(text), Error);
}

TEST(Broadcast, CopiesTheValueOfTheRootToAllRanks) {
  for (int root = 0; root < test::sizeOf(); ++root) {
    Shape shape;
    shape.name = "rank " + std::to_string(test::rankOf());
    std::vector<std::optional<std::string>> texts(test::rankOf(), "x");
    if (test::rankOf() == root) {
      shape = sample();
      texts = {"a", std::nullopt, ""};
    }
    broadcast(PETSC_COMM_WORLD, shape, root);
    broadcast(PETSC_COMM_WORLD, texts, root);
    EXPECT_EQ(shape, sample());
    EXPECT_EQ(texts, (std::vector<std::optional<std::string>>{"a", std::nullopt, ""}));
  }
}

TEST(Object, GivesTheCommunicatorOfAHandle) {
  OwnedVec vector;
  check(VecCreateSeq(PETSC_COMM_SELF, 2, vector.out()));
  EXPECT_EQ(test::sizeOf(commOf(vector)), 1);
  EXPECT_EQ(commOf(vector), commOf(vector.get()));
  check(PetscObjectSetName(object(vector), "forces"));
  const char* name = nullptr;
  check(PetscObjectGetName(object(vector.get()), &name));
  EXPECT_STREQ(name, "forces");
}

}  // namespace
}  // namespace squeal
