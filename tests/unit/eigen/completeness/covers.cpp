// SPDX-License-Identifier: BSD-2-Clause
// Which points the proof in the basis of the sweep covers.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "eigen/completeness/completeness.hpp"
#include "support/algebra/sparse.hpp"

namespace {

using namespace squeal;

pencil::Term term(int power, int frictionExponent = 0) {
  return {.matrix = test::matrixOf(2, {{0, 0, 1}, {1, 1, 2}}),
          .power = power,
          .frictionExponent = frictionExponent};
}

pencil::Pencil pencilWith(std::vector<pencil::Term> more = {}) {
  std::vector<pencil::Term> terms;
  for (const int power : {0, 2}) terms.push_back(term(power));
  terms.push_back(term(0, 1));
  for (auto& one : more) terms.push_back(std::move(one));
  return pencil::Pencil(std::move(terms));
}

std::vector<pencil::Term> only(pencil::Term one) {
  std::vector<pencil::Term> list;
  list.push_back(std::move(one));
  return list;
}

bool isCovered(pencil::Pencil pencil, double friction, const char* missing = "") {
  pencil::FrictionFactors factors;
  factors.missing = missing;
  return completeness::covers({{friction}, std::move(pencil)}, factors);
}

// Stiffness, mass and friction that all points share.
TEST(Covers, SharedTermsWithoutDamping) {
  EXPECT_TRUE(isCovered(pencilWith(), 0.5));
  EXPECT_FALSE(isCovered(pencilWith(), 0.5, "the directions of slip differ"));
  EXPECT_FALSE(isCovered(pencilWith(only(term(1))), 0.5));
}

// The bounds are those of the shared stiffness: a stiffness of the point itself, such as a
// geometric one, would be left out of them, although without friction it is like a part of K0.
TEST(Covers, NoPointWithTermsOfItsOwn) {
  const pencil::Pencil shared = pencilWith();
  for (const double friction : {0.0, 0.5}) {
    EXPECT_FALSE(isCovered(shared.with(only(term(0))), friction));
    EXPECT_FALSE(isCovered(shared.with(only(term(2))), friction));
  }
  // Without effect at this point.
  EXPECT_TRUE(isCovered(shared.with(only(term(0, 1))), 0));
}

}  // namespace
