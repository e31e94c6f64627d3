// SPDX-License-Identifier: BSD-2-Clause
// Small dense linear systems, real and complex, with their adjoints, and singular ones.
#include "algebra/linalg/lu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "support/algebra/dense.hpp"

namespace squeal {
namespace {

double next(std::mt19937& generator, double) { return test::uniform(generator); }
Complex next(std::mt19937& generator, Complex) {
  const double real = test::uniform(generator);
  return {real, test::uniform(generator)};
}
double adjointOf(double a) { return a; }
Complex adjointOf(Complex a) { return std::conj(a); }

template <class Scalar>
class LuOf : public testing::Test {};
using Scalars = testing::Types<double, Complex>;
TYPED_TEST_SUITE(LuOf, Scalars);

// Two columns at once. A random matrix of order 30 has a condition number of some hundreds: 1e-12
// leaves four digits for it.
TYPED_TEST(LuOf, SolvesWithTheMatrixAndItsAdjoint) {
  constexpr PetscInt n = 30;
  linalg::Dense<TypeParam> a(n, n), x(n, 2);
  std::mt19937 generator(1);
  for (auto* matrix : {&a, &x})
    for (auto& entry : matrix->entries()) entry = next(generator, TypeParam());
  const linalg::Lu<TypeParam> lu(a);
  for (const bool adjoint : {false, true}) {
    linalg::Dense<TypeParam> b(n, 2);
    for (PetscInt c = 0; c < 2; ++c)
      for (PetscInt i = 0; i < n; ++i)
        for (PetscInt j = 0; j < n; ++j)
          b(i, c) += (adjoint ? adjointOf(a(j, i)) : a(i, j)) * x(j, c);
    lu.solve(b, adjoint);
    for (std::size_t k = 0; k < x.size(); ++k)
      EXPECT_LT(std::abs(b.entries()[k] - x.entries()[k]), 1e-12) << k;
  }
}

TYPED_TEST(LuOf, ComparesPivots) {
  const auto pivotRatio = [](std::vector<TypeParam> columns) {
    return linalg::Lu<TypeParam>({2, 2, std::move(columns)}).pivotRatio();
  };
  EXPECT_NEAR(pivotRatio({4, 0, 0, 1e-5}), 2.5e-6, 1e-20);
  EXPECT_EQ(pivotRatio({1, 2, 2, 4}), 0);
  EXPECT_EQ(pivotRatio({0, 0, 0, 0}), 0);
}

// Inverse iteration with a singular matrix: its null vector (2, -1) in one step, whatever it starts
// from.
TYPED_TEST(LuOf, GoesAlongTheNullVectorOnceZeroPivotsAreRaised) {
  linalg::Lu<TypeParam> lu({2, 2, {1, 2, 2, 4}});
  lu.raiseZeroPivots();
  std::vector<TypeParam> b{1, 1};
  lu.solve(std::span(b));
  EXPECT_GT(std::abs(b[0]), 1e14);
  EXPECT_LT(std::abs(b[0] / b[1] + 2.0), 1e-14);
}

// A comparison with a NaN is false: its place among the pivots must not matter.
TEST(Lu, OfAnEntryThatIsNoNumberHasNoPivotRatio) {
  EXPECT_EQ(linalg::Lu(test::square({1, 0, 0, NAN})).pivotRatio(), 0);
  EXPECT_EQ(linalg::Lu(test::square({NAN, 0, 0, 1})).pivotRatio(), 0);
}

}  // namespace
}  // namespace squeal
