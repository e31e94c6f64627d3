// SPDX-License-Identifier: BSD-2-Clause
// Roots of known functions in a bracket.
#include "eigen/stability/bracketed_root.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace squeal::stability {
namespace {

struct Result {
  double root;
  int evaluations;
};

Result search(const std::function<double(double)>& f, double a, double b, double tolerance) {
  BracketedRoot search({a, f(a)}, {b, f(b)}, tolerance);
  int count = 0;
  while (!search.done()) {
    const double x = search.next();
    EXPECT_GT(x, std::min(a, b));
    EXPECT_LT(x, std::max(a, b));
    search.take(f(x));
    ++count;
  }
  return {search.root(), count};
}

// The first point is that of the secant, which is the root of a linear function.
TEST(BracketedRoot, OfALineTakesOneEvaluation) {
  const Result found = search([](double x) { return 4 * x - 1; }, 0, 1, 1e-12);
  EXPECT_EQ(found.root, 0.25);
  EXPECT_EQ(found.evaluations, 1);
}

// At the end the bracket is shorter than two tolerances, so that either end is that near the root.
// Inverse quadratic interpolation takes a few evaluations, bisection forty.
TEST(BracketedRoot, OfSmoothFunctionsIsFoundFast) {
  const auto cubic = [](double x) { return x * x * x - 2; };
  const auto cosine = [](double x) { return std::cos(x) - x; };
  const auto exponential = [](double x) { return std::exp(-x) - 0.1; };
  struct Case {
    std::function<double(double)> f;
    double a, b, root;
  };
  for (const auto& [f, a, b, root] :
       {Case{cubic, 0, 2, std::cbrt(2)}, Case{cubic, 2, 0, std::cbrt(2)},
        Case{cosine, 0, 1.5, 0.73908513321516064}, Case{exponential, 0, 10, std::log(10)}}) {
    const Result found = search(f, a, b, 1e-12);
    EXPECT_NEAR(found.root, root, 2e-12);
    EXPECT_LE(found.evaluations, 14);
  }
}

// Where interpolation is not safe it bisects: at a flat root, and at a jump, which a bracket keeps.
TEST(BracketedRoot, FallsBackToBisection) {
  const Result flat = search([](double x) { return std::pow(x - 1, 9); }, 0, 2.5, 1e-6);
  EXPECT_NEAR(flat.root, 1, 2e-6);
  EXPECT_LE(flat.evaluations, 2 * std::log2(2.5 / 1e-6));
  const Result jump = search([](double x) { return x < 0.3 ? -1.0 : 5.0; }, 0, 1, 1e-9);
  EXPECT_NEAR(jump.root, 0.3, 2e-9);
  EXPECT_LE(jump.evaluations, 2 * std::log2(1 / 1e-9));
}

// The end with the smaller value is the root, and a zero ends the search.
TEST(BracketedRoot, EndsAtAZero) {
  BracketedRoot search({0, -1}, {1, 3}, 1e-3);
  EXPECT_EQ(search.next(), 0.25);
  search.take(0);
  EXPECT_TRUE(search.done());
  EXPECT_EQ(search.root(), 0.25);
}

}  // namespace
}  // namespace squeal::stability
