// SPDX-License-Identifier: BSD-2-Clause
// Groups of neighbouring pairs: which pairs form a group, when the iteration of a group ends, and
// eigenvalues that are known in closed form.
#include "eigen/reduction/pair_group.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/algebra/dense.hpp"
#include "support/algebra/oscillators.hpp"
#include "support/algebra/quadratic.hpp"

namespace squeal::test {
namespace {

using linalg::DenseMatrix;
using linalg::DensePair;
using linalg::DenseProblem;
using reduction::Companion;
using reduction::PairGroup;
using reduction::UnconvergedPair;
using Outcome = PairGroup::Outcome;

constexpr PetscInt order = 12;
constexpr double ratio = 0.02;  // damping ratio of all modes

/// Modes of 1, 2, … rad/s that nothing couples: the eigenvectors are unit vectors, and
///   s_j = ω_j (−ζ + i √(1 − ζ²)).
DenseProblem uncoupled() {
  std::vector<double> damping, stiffness;
  for (PetscInt j = 0; j < order; ++j) {
    damping.push_back(2 * ratio * (j + 1));
    stiffness.push_back((j + 1) * (j + 1));
  }
  return {identity(order), diagonal(damping), diagonal(stiffness)};
}

Complex exact(std::size_t j) { return (j + 1.0) * Complex(-ratio, std::sqrt(1 - ratio * ratio)); }

/// Returns the length of P(s) x or, for the left side, of P(s)ᴴ y. The matrices are diagonal.
double residualOf(const DenseProblem& problem, const DensePair& pair, bool left) {
  const auto& x = left ? pair.left : pair.q;
  double sum = 0;
  for (PetscInt k = 0; k < order; ++k)
    sum += std::norm(
        (pair.s * (pair.s * problem.mass(k, k) + problem.damping(k, k)) + problem.stiffness(k, k)) *
        x[k]);
  return std::sqrt(sum);
}

/// Returns all pairs with vectors of length 1 that have parts of about `error` along the others.
std::vector<DensePair> disturbed(double error) {
  std::mt19937 generator(3);
  std::vector<DensePair> pairs;
  for (PetscInt j = 0; j < order; ++j) {
    DensePair& pair = pairs.emplace_back(DensePair{exact(j), {}, {}});
    for (auto* vector : {&pair.q, &pair.left}) {
      vector->resize(order);
      for (auto& entry : *vector) entry = error * Complex(uniform(generator), uniform(generator));
      (*vector)[j] = 1;
      const double size = length(*vector);
      for (auto& entry : *vector) entry /= size;
    }
  }
  return pairs;
}

// Imaginary parts from 0 to 10: a group is at most 2 wide, whatever the order of the list.
TEST(PairGroups, AreAtMostAFifthOfTheListWide) {
  std::vector<DensePair> pairs;
  for (int j = 0; j <= 10; ++j) pairs.push_back({Complex(-0.1 * j, j), {}, {}});
  std::vector<UnconvergedPair> open;
  for (const std::size_t j : {7, 0, 10, 3, 2, 9, 8, 1, 4, 6}) open.push_back({j, 0.1, 0.2});
  std::vector<std::vector<std::size_t>> found;
  for (const auto& group : reduction::groupsOf(pairs, open)) {
    found.emplace_back();
    for (const auto& one : group) found.back().push_back(one.pair);
  }
  EXPECT_EQ(found, (std::vector<std::vector<std::size_t>>{{0, 1, 2}, {3, 4}, {6, 7, 8}, {9, 10}}));
  EXPECT_TRUE(reduction::groupsOf(pairs, {}).empty());
}

// A group whose residuals may remain as they are is left as it is.
TEST(PairGroup, IsNotTouchedWhereNothingIsAskedFor) {
  const DenseProblem problem = uncoupled();
  const Companion companion(problem, 6);
  auto pairs = disturbed(1e-3);
  const auto before = pairs;
  PairGroup group(companion, pairs, {{4, 1, 1}, {5, 1, 1}});
  EXPECT_EQ(group.members(), (std::vector<std::size_t>{4, 5}));
  EXPECT_EQ(group.iterate(false), Outcome::untouched);
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    EXPECT_EQ(pairs[j].s, before[j].s);
    EXPECT_EQ(pairs[j].q, before[j].q);
    EXPECT_EQ(pairs[j].left, before[j].left);
  }
}

// Nor is one whose residuals are round-off, however small they are to be.
TEST(PairGroup, IsNotTouchedWhereOnlyRoundOffIsLeft) {
  const DenseProblem problem = uncoupled();
  const Companion companion(problem, 6);
  auto pairs = disturbed(0);
  PairGroup group(companion, pairs, {{4, 1e-30, 1e-30}});
  EXPECT_EQ(group.iterate(false), Outcome::untouched);
}

// With residuals r and l of the right and left vectors and p_k(s) the entries of P(s), the error of
// the Ritz value of the first vectors is
//   |δs| ≤ ‖r‖ ‖l‖ / (min |p_k(s)| |p_j′(s)|),  k ≠ j,
// to second order; after a step it is at most that. Pairs outside of the group stay as they are.
void expectImproved(const std::vector<std::size_t>& members, double part, Outcome outcome) {
  const DenseProblem problem = uncoupled();
  const Companion companion(problem, 6);
  auto pairs = disturbed(1e-3);
  const auto before = pairs;
  std::vector<UnconvergedPair> open;
  for (const auto j : members) open.push_back({j, part, part});
  EXPECT_EQ(PairGroup(companion, pairs, open).iterate(false), outcome);
  bool reached = true;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (std::ranges::find(members, j) == members.end()) {
      EXPECT_EQ(pairs[j].s, before[j].s);
      EXPECT_EQ(pairs[j].q, before[j].q);
      continue;
    }
    const double right = residualOf(problem, before[j], false),
                 left = residualOf(problem, before[j], true);
    reached = reached && residualOf(problem, pairs[j], false) <= part * right &&
              residualOf(problem, pairs[j], true) <= part * left;
    EXPECT_NEAR(length(pairs[j].q), 1, 1e-14);
    EXPECT_NEAR(length(pairs[j].left), 1, 1e-14);
    double least = INFINITY;
    for (PetscInt k = 0; k < order; ++k)
      if (k != PetscInt(j))
        least = std::min(least, std::abs(exact(j) * (exact(j) + problem.damping(k, k)) +
                                         problem.stiffness(k, k)));
    const double slope = std::abs(2.0 * exact(j) + problem.damping(j, j));
    EXPECT_LT(std::abs(pairs[j].s - exact(j)), right * left / (least * slope));
  }
  EXPECT_EQ(reached, outcome == Outcome::done);
}

TEST(PairGroup, ReachesTheResidualsThatAreAskedFor) {
  expectImproved({4, 5, 7}, 0.01, Outcome::done);  // in two steps
  // The shift is 0.0056 from s of a single pair, and 1 from the next.
  expectImproved({4}, 1e-3, Outcome::done);
}

// Two steps are made, and what they leave is said to be unfinished.
TEST(PairGroup, SaysWhatItHasNotFinished) { expectImproved({4, 5, 7}, 1e-9, Outcome::unfinished); }

// Two oscillators beyond the friction at which their frequencies merge: the vectors of both pairs
// and their images span the whole space, where one step is exact to round-off.
TEST(PairGroup, IsExactInTheWholeSpace) {
  const Oscillators model{1, 1.5, 1};
  const double friction = 2 * model.critical();
  const DenseProblem problem{identity(2), DenseMatrix(2, 2), model.stiffness(friction)};
  const auto wanted = model.exact(friction);
  auto pairs = linalg::solveQuadratic(problem, linalg::Vectors::both);
  ASSERT_EQ(pairs.size(), 2U);
  for (auto& pair : pairs) {
    pair.s *= Complex(1.01, 0.01);
    pair.q[0] *= 1.02;
    pair.left[1] *= 0.98;
  }
  const Companion companion(problem, 1);
  PairGroup group(companion, pairs, {{0, 1, 1}, {1, 1, 1}});
  EXPECT_NE(group.iterate(true), Outcome::failed);
  for (std::size_t j = 0; j < 2; ++j) EXPECT_LT(std::abs(pairs[j].s - wanted[j]), 1e-14);
}

// P(σ) is singular for every shift if an unknown has neither mass nor stiffness.
TEST(PairGroup, FailsWherePIsSingular) {
  DenseProblem problem = uncoupled();
  const PetscInt last = order - 1;
  problem.mass(last, last) = problem.damping(last, last) = problem.stiffness(last, last) = 0;
  const Companion companion(problem, 6);
  auto pairs = disturbed(1e-3);
  const auto before = pairs;
  PairGroup group(companion, pairs, {{4, 0.1, 0.1}});
  EXPECT_EQ(group.iterate(false), Outcome::failed);
  EXPECT_EQ(pairs[4].s, before[4].s);
  EXPECT_EQ(pairs[4].q, before[4].q);
}

}  // namespace
}  // namespace squeal::test
