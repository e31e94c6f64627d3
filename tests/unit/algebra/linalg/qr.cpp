// SPDX-License-Identifier: BSD-2-Clause
// The QR factorisation of a Vandermonde matrix.
#include "algebra/linalg/qr.hpp"

#include <gtest/gtest.h>

#include "support/run/case.hpp"

namespace squeal {
namespace {

using linalg::DenseMatrix;

TEST(Qr, OrthogonalAndInverse) {
  DenseMatrix a(6, 4), wanted(3, 4);
  for (PetscInt i = 0; i < 6; ++i)
    for (PetscInt j = 0; j < 4; ++j) a(i, j) = std::pow(0.2 * i, j);
  for (PetscInt i = 0; i < 3; ++i)
    for (PetscInt j = 0; j < 4; ++j) wanted(i, j) = i - 2.0 * j;
  const linalg::Qr qr(a);
  const DenseMatrix unit = linalg::transposedProduct(qr.q(), qr.q()),
                    r = linalg::transposedProduct(qr.q(), a);
  for (PetscInt i = 0; i < 6; ++i)
    for (PetscInt j = 0; j < 6; ++j) EXPECT_NEAR(unit(i, j), i == j, 1e-14);
  for (PetscInt j = 0; j < 4; ++j)
    for (PetscInt i = j + 1; i < 6; ++i) EXPECT_NEAR(r(i, j), 0, 1e-14);
  // B = W R gives W again; the condition number of R is some 1e2.
  DenseMatrix b = linalg::product(wanted, linalg::rowRange(r, 0, 4));
  qr.divideByR(b);
  for (PetscInt i = 0; i < 3; ++i)
    for (PetscInt j = 0; j < 4; ++j) EXPECT_NEAR(b(i, j), wanted(i, j), 1e-12);
}

TEST(Qr, WithoutColumns) {
  const linalg::Qr qr(DenseMatrix(3, 0));
  ASSERT_EQ(qr.q().columns(), 3);
  for (PetscInt i = 0; i < 3; ++i) EXPECT_NEAR(std::abs(qr.q()(i, i)), 1, 1e-15);
}

// RᵀR = AᵀA, for matrices with more rows and with more columns.
TEST(Qr, TriangularFactor) {
  for (const auto& [m, n] : {std::pair(6, 4), std::pair(3, 5), std::pair(0, 2)}) {
    DenseMatrix a(m, n);
    for (PetscInt i = 0; i < m; ++i)
      for (PetscInt j = 0; j < n; ++j) a(i, j) = std::pow(0.2 * i, j) + (i == j);
    const auto r = linalg::triangularFactor(a);
    ASSERT_EQ(r.rows(), std::min(m, n));
    const auto expected = linalg::transposedProduct(a, a),
               product = linalg::transposedProduct(r, r);
    for (PetscInt i = 0; i < n; ++i)
      for (PetscInt j = 0; j < n; ++j) EXPECT_NEAR(product(i, j), expected(i, j), 1e-13);
    for (PetscInt j = 0; j < n; ++j)
      for (PetscInt i = j + 1; i < r.rows(); ++i) EXPECT_EQ(r(i, j), 0);
  }
}

}  // namespace
}  // namespace squeal
