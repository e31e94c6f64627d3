// SPDX-License-Identifier: BSD-2-Clause
// P-matrices, and what is concluded from a small condensed matrix A(f).
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "steady/uniqueness/uniqueness.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/minors.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/ranks.hpp"

namespace squeal {
namespace {

using test::contains;
using test::square;

TEST(PMatrix, KnownOnes) {
  EXPECT_TRUE(uniqueness::pMatrix(square({1, 0, 0, 1})));
  EXPECT_TRUE(
      uniqueness::pMatrix(square({1, 0, -3, 1})));  // its symmetric part has the eigenvalue 1 − 1.5
  EXPECT_FALSE(uniqueness::pMatrix(square({1, 2, 2, 1})));  // determinant −3
  EXPECT_FALSE(uniqueness::pMatrix(square({0, -1, 1, 0})));
  EXPECT_FALSE(uniqueness::pMatrix(square({-1})));
  // [1 0 −c; −c 1 0; 0 −c 1]: all minors of order two are 1, the determinant is 1 − c³.
  for (const double c : {0.99, 1.01})
    EXPECT_EQ(uniqueness::pMatrix(square({1, -c, 0, 0, 1, -c, -c, 0, 1})), c < 1);
  // Tiny units are no smaller minors.
  EXPECT_TRUE(uniqueness::pMatrix(square({1e-9, 0, -3e-9, 1e-9})));
  EXPECT_TRUE(uniqueness::pMatrix(square({1e-20, 0, 0, 1})));
}

TEST(PMatrix, AgreesWithAllMinors) {
  std::mt19937 generator(5);
  int yes = 0, no = 0, indefinite = 0;
  for (int trial = 0; trial < 200; ++trial) {
    linalg::DenseMatrix a(6, 6);
    for (double& entry : a.entries()) entry = 1.5 * test::uniform(generator);
    for (PetscInt i = 0; i < 6; ++i) a(i, i) = 0.8 + std::abs(a(i, i));
    const bool expected = test::smallestMinor(a) > 0;
    EXPECT_EQ(uniqueness::pMatrix(a), expected) << "trial " << trial;
    ++(expected ? yes : no);
    indefinite += expected && uniqueness::eigenvaluesOfSymmetricPart(a).front() < 0;
  }
  test::print("%d P-matrices, %d of them not positive definite, %d others\n", yes, indefinite, no);
  EXPECT_GE(yes, 20);
  EXPECT_GE(no, 20);
  EXPECT_GE(indefinite, 5);
}

TEST(Verdict, IsTheStrongestThatHolds) {
  const auto verdict = [](const std::vector<double>& a, int limit = 18) {
    return uniqueness::examineMatrix(square(a), 0.3, limit).verdict;
  };
  EXPECT_EQ(verdict({2, -1, -1, 2}), "one solution");
  EXPECT_EQ(verdict({2, -1, -1, 2}, 0), "one solution");
  EXPECT_EQ(verdict({1, 0, -3, 1}), "one solution");  // a P-matrix, not positive definite
  EXPECT_EQ(verdict({1, 0, -3, 1}, 1), "not decided");
  EXPECT_EQ(verdict({1, 2, 2, 1}), "a solution exists");  // g = A R + F with F = (−1, −1) has three
  EXPECT_EQ(verdict({1, -2, -2, 1}), "not decided");
  EXPECT_EQ(verdict({1, -1, -1, 1}), "not decided");  // on the border
  const auto judgement = uniqueness::examineMatrix(square({1, 2, 2, 1}), 0.3, 18);
  EXPECT_EQ(judgement.friction, 0.3);
  EXPECT_NEAR(judgement.smallest, -1, 1e-14);
  EXPECT_TRUE(contains(judgement.reason, "no P-matrix")) << judgement.reason;
}

TEST(Loss, IsTheFirstFrictionWithoutPositivity) {
  EXPECT_NEAR(uniqueness::lossOfPositivity(square({1, 0, 0, 1}), square({0, -2, 0, 0})), 1,
              1e-14);  // 1 − f² = 0
  EXPECT_NEAR(uniqueness::lossOfPositivity(square({2, 0, 0, 1}), square({-1, 0, 0, 0.25})), 2,
              1e-14);  // 2 − f = 0
  EXPECT_EQ(uniqueness::lossOfPositivity(square({2, 0, 0, 1}), square({0, -5, 5, 0})),
            INFINITY);  // skew
  EXPECT_EQ(uniqueness::lossOfPositivity(square({2, 0, 0, 1}), square({1, 0, 0, 0})), INFINITY);
  EXPECT_EQ(uniqueness::lossOfPositivity(square({1, 2, 2, 1}), square({1, 0, 0, 1})), 0);
}

}  // namespace
}  // namespace squeal
