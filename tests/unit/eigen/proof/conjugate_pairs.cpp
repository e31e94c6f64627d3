// SPDX-License-Identifier: BSD-2-Clause
// Vectors in conjugate pairs, stored as real numbers: two real ones with a pair between them.
#include "eigen/proof/conjugate_pairs.hpp"

#include <gtest/gtest.h>

#include "support/algebra/dense.hpp"

namespace {

using namespace squeal;
using linalg::ComplexMatrix;
using linalg::DenseMatrix;
using proof::Member;

const proof::ConjugatePairs pairs{Member::real, Member::first, Member::second, Member::real};

DenseMatrix random(PetscInt rows, PetscInt columns) {
  std::mt19937 generator(7);
  return test::randomMatrix(rows, columns, generator);
}

/// Expects equal matrices within the round-off of sums of a few products of numbers near 1.
void expectNear(const ComplexMatrix& a, const ComplexMatrix& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.columns(), b.columns());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LE(std::abs(a.data()[i] - b.data()[i]), 1e-13);
}

TEST(ConjugatePairs, ColumnsHoldTheirParts) {
  const DenseMatrix stored = random(3, 4);
  const auto x = proof::complexColumns(stored, pairs);
  for (PetscInt i = 0; i < 3; ++i) {
    EXPECT_EQ(x(i, 0), stored(i, 0));
    EXPECT_EQ(x(i, 1), Complex(stored(i, 1), stored(i, 2)));
    EXPECT_EQ(x(i, 2), std::conj(x(i, 1)));
    EXPECT_EQ(x(i, 3), stored(i, 3));
  }
}

// X G = X_r (U G),   Y A X = U⁻¹ (Y_r A X_r) U with Y = U⁻¹ Y_r and X = X_r U
TEST(ConjugatePairs, ProductsAgree) {
  const DenseMatrix x = random(5, 4), y = random(4, 5), a = random(5, 5);
  ComplexMatrix g(4, 2);
  for (std::size_t i = 0; i < g.size(); ++i) g.data()[i] = {0.3 * i - 1, 0.7 - 0.2 * i};
  expectNear(linalg::product(x, proof::storedRows(g, pairs)),
             linalg::product(proof::complexColumns(x, pairs), g));
  expectNear(proof::complexForm(linalg::product(y, linalg::product(a, x)), pairs),
             linalg::product(proof::complexRows(y, pairs),
                             linalg::product(a, proof::complexColumns(x, pairs))));
}

// The rows of the inverse belong to the columns of the matrix.
TEST(ConjugatePairs, RowsBelongToColumns) {
  DenseMatrix unit(4, 4);
  for (PetscInt i = 0; i < 4; ++i) unit(i, i) = 1;
  expectNear(linalg::product(proof::complexRows(unit, pairs), proof::complexColumns(unit, pairs)),
             proof::complexForm(unit, pairs));
  const auto identity = proof::complexForm(unit, pairs);
  for (PetscInt j = 0; j < 4; ++j)
    for (PetscInt i = 0; i < 4; ++i)
      EXPECT_LE(std::abs(identity(i, j) - (i == j ? 1.0 : 0.0)), 1e-15);
}

}  // namespace
