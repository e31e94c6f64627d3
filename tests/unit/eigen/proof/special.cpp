// SPDX-License-Identifier: BSD-2-Clause
// Special cases: nothing left out, an eigenvalue on the boundary, a double eigenvalue.
#include <gtest/gtest.h>

#include "eigen/proof/count.hpp"
#include "eigen/proof/enclosure.hpp"
#include "support/algebra/dense.hpp"

namespace {

using namespace squeal;
using proof::Verdict;
using test::diagonal;

/// Oscillators with these angular frequencies and damping ratios, in energy coordinates.
proof::KeptProblem oscillators(const std::vector<double>& omega, double ratio) {
  std::vector<double> mass, damping;
  for (const double w : omega) {
    mass.push_back(1 / (w * w));
    damping.push_back(2 * ratio / w);
  }
  proof::KeptProblem problem;
  problem.matrices = {test::identity(std::ssize(omega)),
                      ratio > 0 ? diagonal(damping) : linalg::DenseMatrix(), diagonal(mass)};
  return problem;
}

// Then all is known up to round-off, and so are the eigenvalues.
TEST(Special, NothingLeftOut) {
  for (const double ratio : {0.0, 0.01}) {
    const proof::DiagonalForm form(oscillators({10, 20, 35, 70}, ratio), 50);
    const auto proof = proof::proveCount(form, {}, {50, 5});
    EXPECT_EQ(proof.verdict, Verdict::proved);
    EXPECT_EQ(proof.count, 6);
    EXPECT_LT(proof.ratio, 1e-9);
    const auto discs = proof::enclose(form, {}, {50, 5});
    ASSERT_EQ(discs.size(), 6u);
    for (const auto& disc : discs) {
      EXPECT_EQ(disc.isolation, proof::Isolation::single);
      EXPECT_LT(disc.inner, 1e-9);
      EXPECT_GT(disc.outer, 1);
      EXPECT_EQ(disc.neutral, ratio == 0);
    }
    const auto high = [](Complex s) { return std::abs(s) > 30; };
    EXPECT_EQ(proof::enclose(form, {}, {50, 5}, {}, high).size(), 2u);
  }
}

TEST(Special, AnEigenvalueOnTheBoundary) {
  const proof::DiagonalForm form(oscillators({10, 20, 35}, 0), 20);
  const auto proof = proof::proveCount(form, {}, {20});
  EXPECT_EQ(proof.verdict, Verdict::edge);
  EXPECT_LT(proof.edgeDistance, 1e-12);
  EXPECT_NEAR(std::abs(proof.place - Complex(0, 20)), 0, 1e-9);
  // On the left edge: s = −0.2 ± 19.999i with damping ratio 0.01.
  const proof::DiagonalForm damped(oscillators({10, 20, 35}, 0.01), 27);
  const auto left = proof::proveCount(damped, {}, {27, 0.2});
  EXPECT_EQ(left.verdict, Verdict::edge);
  EXPECT_LT(left.edgeDistance, 1e-12);
}

TEST(Special, ASingularMatrixAtTheTop) {
  auto problem = oscillators({10, 20}, 0);
  problem.matrices[0](1, 1) = -1;  // s = ±20, real
  const proof::DiagonalForm form(problem, 20);
  EXPECT_NE(proof::proveCount(form, {}, {20}).verdict, Verdict::proved);
  const proof::DiagonalForm above(problem, 25);
  const auto proof = proof::proveCount(above, {}, {25});
  EXPECT_EQ(proof.verdict, Verdict::proved);
  EXPECT_EQ(proof.count, 4);
}

// Two oscillators at the friction where they merge, s² = −400 twice with one vector, and at
// distances from it: the count does not depend on accurate eigenvectors.
TEST(Special, ADoubleEigenvalueWithOneVector) {
  for (const double apart : {0.0, 1e-14, 1e-12, 1e-9, 1e-6}) {
    auto problem = oscillators({20, 20, 50}, 0);
    problem.matrices[0](0, 1) = 0.1;
    problem.matrices[0](1, 0) = 0.1 * apart;
    const proof::DiagonalForm form(problem, 30);
    const auto proof = proof::proveCount(form, {}, {30});
    EXPECT_EQ(proof.verdict, Verdict::proved);
    EXPECT_EQ(proof.count, 4);
  }
}

// Equal eigenvalues with a vector each.
TEST(Special, EqualEigenvalues) {
  const proof::DiagonalForm form(oscillators({20, 20, 20, 50}, 0), 30);
  const auto proof = proof::proveCount(form, {}, {30});
  EXPECT_EQ(proof.verdict, Verdict::proved);
  EXPECT_EQ(proof.count, 6);
  for (const auto& disc : proof::enclose(form, {}, {30}))
    EXPECT_EQ(disc.isolation, proof::Isolation::neighbour);
}

// An entry that is not a number proves nothing, wherever it is.
TEST(Special, NotANumber) {
  const double nan = std::nan("");
  for (int where = 0; where < 6; ++where) {
    auto problem = oscillators({10, 20}, 0.01);
    const linalg::DenseMatrix none;
    problem.toLeftOut = {proof::Coupling{{none, none, diagonal(std::vector{1e-6, 1e-6})}}};
    problem.fromLeftOut = problem.toLeftOut;
    proof::LeftOut bounds;
    bounds.mass = 1e-3;
    if (where == 1) problem.matrices[0](1, 0) = nan;
    if (where == 2) problem.matrices[2](0, 0) = nan;
    if (where == 3) problem.toLeftOut[0].coefficients[2](1, 1) = nan;
    if (where == 4) problem.fromLeftOut[0].error[0] = nan;
    if (where == 5) bounds.damping = nan;
    const proof::DiagonalForm form(problem, 15);
    const auto proof = proof::proveCount(form, bounds, {15, 3});
    EXPECT_EQ(proof.verdict == Verdict::proved, where == 0) << where;
    if (where == 0 || !form.regular()) continue;
    for (const auto& disc : proof::enclose(form, bounds, {15, 3}))
      EXPECT_NE(disc.isolation, proof::Isolation::single) << where;
  }
}

}  // namespace
