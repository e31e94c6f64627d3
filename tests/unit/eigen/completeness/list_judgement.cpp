// SPDX-License-Identifier: BSD-2-Clause
// The judgement of a list by given discs: band |s| ≤ 100 rad/s, damping ratio up to 0.5, region |s|
// < 105 and Re s > −20.
#include <gtest/gtest.h>

#include <cmath>

#include "eigen/completeness/list_judgement.hpp"

namespace {

using namespace squeal;
using proof::Enclosure;
using proof::Isolation;

const proof::Region region{.top = 105, .left = 20};

/// A disc that proves one eigenvalue within the inner radius.
Enclosure disc(Complex s, double inner = 0.1, double outer = 1) {
  Enclosure result;
  result.s = s;
  result.isolation = Isolation::single;
  result.inner = inner, result.outer = outer;
  return result;
}

pencil::ComplexModes point(const std::vector<Complex>& list) {
  pencil::ComplexModes result;
  result.bandTop = 100;
  result.tolerance = 1e-6;
  for (const auto s : list) {
    pencil::Eigenvalue e;
    e.s = s;
    result.eigenvalues.push_back(e);
  }
  result.completeness.emplace();
  result.completeness->proved = true;
  result.completeness->left = region.left;
  return result;
}

pencil::ComplexModes judged(const std::vector<Complex>& list, const std::vector<Enclosure>& discs) {
  auto result = point(list);
  completeness::judgeList(discs, region, {}, result);
  return result;
}

TEST(ListJudgement, CompleteListHasARadiusForEachEntry) {
  const auto found = judged({{1, 30}, {-2, 60}}, {disc({1, 30}), disc({-2, 60.05})});
  EXPECT_TRUE(found.listIsProved());
  EXPECT_DOUBLE_EQ(found.eigenvalues[0].radius, 0.1);
  EXPECT_NEAR(found.eigenvalues[1].radius, 0.15, 1e-12);  // its distance from the centre is added
}

// An entry left of the region is not judged, and does not prevent a proof.
TEST(ListJudgement, EntryLeftOfTheRegionIsNotJudged) {
  const auto found = judged({{1, 30}, {-25, 60}}, {disc({1, 30})});
  EXPECT_TRUE(found.listIsProved());
  EXPECT_TRUE(std::isnan(found.eigenvalues[1].radius));
}

TEST(ListJudgement, MissingEigenvalueInTheBand) {
  const auto found = judged({{1, 30}}, {disc({1, 30}), disc({3, 70})});
  ASSERT_EQ(found.completeness->missing.size(), 1u);
  EXPECT_EQ(found.completeness->missing[0].centre, Complex(3, 70));
  EXPECT_FALSE(found.listIsProved());
}

// Above the band, or damped too strongly for it.
TEST(ListJudgement, EigenvaluesOutsideTheBandAreNotMissing) {
  const auto found =
      judged({{1, 30}}, {disc({1, 30}), disc({0, 102}), disc({-15, 10}), disc({-5, 0})});
  EXPECT_TRUE(found.listIsProved());
}

// The disc reaches across the top of the band, or across its largest damping ratio.
TEST(ListJudgement, DiscAcrossTheEdgeOfTheBandIsUndecided) {
  for (const Complex s : {Complex(0, 99.95), Complex(-5.01, 8.66)}) {
    const auto found = judged({{1, 30}}, {disc({1, 30}), disc(s)});
    EXPECT_TRUE(found.completeness->missing.empty());
    ASSERT_EQ(found.completeness->undecided.size(), 1u);
    EXPECT_EQ(found.completeness->undecided[0], s);
    EXPECT_FALSE(found.listIsProved());
  }
}

// Two eigenvalues that no discs separate, both missing in the list.
TEST(ListJudgement, EigenvaluesWithoutDiscsAreNotPassedOver) {
  Enclosure first, second;
  first.s = {0, 50}, second.s = {0, 50.001};
  const auto found = judged({{1, 30}}, {disc({1, 30}), first, second});
  EXPECT_EQ(found.completeness->undecided.size(), 2u);
  EXPECT_FALSE(found.listIsProved());
}

TEST(ListJudgement, ListedPairWithoutDiscsIsNotProved) {
  Enclosure first, second;
  first.s = {0, 50}, second.s = {0, 50.001};
  const auto found = judged({{0, 50}, {0, 50.001}}, {first, second});
  EXPECT_TRUE(found.completeness->undecided.empty());
  EXPECT_EQ(found.withoutDisc(), 2);
  EXPECT_FALSE(found.listIsProved());
}

// A value in none of the discs, and a value listed twice.
TEST(ListJudgement, SpuriousValuesAreNamed) {
  const auto found = judged({{1, 30}, {1.2, 30}, {0, 80}}, {disc({1, 30})});
  ASSERT_EQ(found.completeness->spurious.size(), 2u);
  EXPECT_EQ(found.completeness->spurious[0], Complex(1.2, 30));
  EXPECT_EQ(found.completeness->spurious[1], Complex(0, 80));
  EXPECT_TRUE(std::isnan(found.eigenvalues[1].radius));
  EXPECT_FALSE(found.listIsProved());
}

// Without a proof of the number, the discs may not contain all eigenvalues.
TEST(ListJudgement, WithoutTheNumberNothingIsSpurious) {
  auto found = point({{1, 30}, {0, 80}});
  found.completeness->proved = false;
  completeness::judgeList({disc({1, 30})}, region, {}, found);
  EXPECT_TRUE(found.completeness->spurious.empty());
}

// Two equal eigenvalues, whose discs are not isolated, take the two entries, although both entries
// are nearer to the same one.
TEST(ListJudgement, EqualEigenvaluesTakeOneEntryEach) {
  std::vector<Enclosure> discs{disc({0, 50}), disc({0, 50 + 1e-9})};
  for (auto& one : discs) one.isolation = Isolation::neighbour;
  EXPECT_TRUE(judged({{0, 50 + 1e-6}, {0, 50 + 1.1e-6}}, discs).completeness->undecided.empty());
  EXPECT_EQ(judged({{0, 50 + 1e-6}}, discs).completeness->undecided.size(), 1U);
}

}  // namespace
