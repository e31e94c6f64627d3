// Small dense linear systems, real and complex, with their adjoints, and singular ones.
#include "linalg/lu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

namespace squeal {
namespace {

using Complex = std::complex<double>;

/// Between -1 and 1.
double uniform(std::mt19937& generator) {
  return 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1;
}
double next(std::mt19937& generator, double) { return uniform(generator); }
Complex next(std::mt19937& generator, Complex) {
  const double real = uniform(generator);
  return {real, uniform(generator)};
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
  constexpr std::size_t n = 30;
  std::vector<TypeParam> a(n * n), x(2 * n);
  std::mt19937 generator(1);
  for (auto* values : {&a, &x})
    for (auto& value : *values) value = next(generator, TypeParam());
  const linalg::Lu<TypeParam> lu(a, n);
  for (const bool adjoint : {false, true}) {
    std::vector<TypeParam> b(2 * n);
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          b[c * n + i] += (adjoint ? adjointOf(a[i * n + j]) : a[j * n + i]) * x[c * n + j];
    lu.solve(b, adjoint);
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LT(std::abs(b[k] - x[k]), 1e-12) << k;
  }
}

TYPED_TEST(LuOf, ComparesPivots) {
  EXPECT_NEAR((linalg::Lu<TypeParam>({4, 0, 0, 1e-5}, 2).pivotRatio()), 2.5e-6, 1e-20);
  EXPECT_EQ((linalg::Lu<TypeParam>({1, 2, 2, 4}, 2).pivotRatio()), 0);
  EXPECT_EQ((linalg::Lu<TypeParam>({0, 0, 0, 0}, 2).pivotRatio()), 0);
}

// Inverse iteration with a singular matrix: its null vector (2, -1) in one step, whatever it starts
// from.
TYPED_TEST(LuOf, GoesAlongTheNullVectorOnceZeroPivotsAreRaised) {
  linalg::Lu<TypeParam> lu({1, 2, 2, 4}, 2);
  lu.raiseZeroPivots();
  std::vector<TypeParam> b{1, 1};
  lu.solve(b);
  EXPECT_GT(std::abs(b[0]), 1e14);
  EXPECT_LT(std::abs(b[0] / b[1] + 2.0), 1e-14);
}

}  // namespace
}  // namespace squeal
