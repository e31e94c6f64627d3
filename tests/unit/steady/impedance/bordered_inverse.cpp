// SPDX-License-Identifier: BSD-2-Clause
// The inverse of a matrix that has lost and gained unknowns, against a factorisation of its own.
#include "steady/impedance/bordered_inverse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/algebra/dense.hpp"

namespace squeal::test {
namespace {

using impedance::BorderedInverse;
using impedance::SymmetricInverse;
using linalg::DenseMatrix;

/// The stiffness of springs between `n` masses in a row, N/m; `grounded`: the first is held too.
DenseMatrix chain(PetscInt n, bool grounded) {
  DenseMatrix a(n, n);
  for (PetscInt i = 0; i < n; ++i) {
    const double spring = 1e8 * (1 + 0.9 * std::sin(1.0 + 2.3 * i));  // without a pattern
    a(i, i) += i > 0 || grounded ? spring : 0;
    if (i == 0) continue;
    a(i - 1, i - 1) += spring;
    a(i, i - 1) -= spring;
    a(i - 1, i) -= spring;
  }
  return a;
}

DenseMatrix part(const DenseMatrix& a, const std::vector<PetscInt>& rows,
                 const std::vector<PetscInt>& columns) {
  DenseMatrix some(rows.size(), columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (std::size_t i = 0; i < rows.size(); ++i) some(i, j) = a(rows[i], columns[j]);
  return some;
}

/// The inverse for the unknowns 0 … n−1 of `a` without those held and with the ones from n on, and
/// what it gives for unit forces.
struct Bordered {
  Bordered(const DenseMatrix& a, PetscInt n, std::vector<PetscInt> held) {
    std::vector<PetscInt> base, added;
    std::vector<double> diagonal;
    for (PetscInt i = 0; i < a.rows(); ++i) (i < n ? base : added).push_back(i);
    for (const PetscInt i : base) diagonal.push_back(a(i, i));
    const SymmetricInverse known(part(a, base, base));
    inverse = BorderedInverse(known, diagonal, part(a, base, added), part(a, added, added), held);
    // One column per force on an unknown that is free.
    for (PetscInt i = 0; i < a.rows(); ++i)
      if (std::ranges::find(held, i) == held.end()) free.push_back(i);
    x = DenseMatrix(n, free.size()), p = DenseMatrix(added.size(), free.size());
    for (std::size_t j = 0; j < free.size(); ++j)
      (free[j] < n ? x(free[j], j) : p(free[j] - n, j)) = 1;
    known.apply(x);
    inverse.complete(x, p);
  }
  double at(PetscInt unknown, PetscInt column) const {
    return unknown < x.rows() ? x(unknown, column) : p(unknown - x.rows(), column);
  }
  BorderedInverse inverse;
  std::vector<PetscInt> free;
  DenseMatrix x, p;
};

// The condition number of the chain is below 1e5: round-off leaves 1e-10 at least.
TEST(BorderedInverse, EqualsAFactorisation) {
  const DenseMatrix a = chain(30, true);
  for (const PetscInt n : {30, 25})
    for (const std::vector<PetscInt>& held : {std::vector<PetscInt>{}, {3}, {0, 7, 8, 24}}) {
      const Bordered bordered(a, n, held);
      EXPECT_TRUE(bordered.inverse.isRegular());
      DenseMatrix wanted(std::ssize(bordered.free), std::ssize(bordered.free));
      for (PetscInt i = 0; i < wanted.rows(); ++i) wanted(i, i) = 1;
      SymmetricInverse(part(a, bordered.free, bordered.free)).apply(wanted);
      double size = 0, error = 0;
      for (PetscInt j = 0; j < wanted.columns(); ++j) {
        for (PetscInt i = 0; i < wanted.rows(); ++i) {
          size = std::max(size, std::abs(wanted(i, j)));
          error = std::max(error, std::abs(bordered.at(bordered.free[i], j) - wanted(i, j)));
        }
        for (const PetscInt i : held) EXPECT_EQ(bordered.at(i, j), 0);
      }
      EXPECT_LE(error, 1e-10 * size) << n << " unknowns, " << held.size() << " held";
    }
}

// Without its ground the chain is free: regular while its last mass is held, singular without.
TEST(BorderedInverse, RecognisesALooseBody) {
  for (PetscInt n = 3; n < 30; ++n) {
    const DenseMatrix a = chain(n, false);
    EXPECT_FALSE(Bordered(a, n - 1, {}).inverse.isRegular()) << n;
    EXPECT_TRUE(Bordered(a, n - 1, {0}).inverse.isRegular()) << n;
    EXPECT_TRUE(Bordered(chain(n, true), n, {n / 2}).inverse.isRegular()) << n;
    // Round-off may leave Cholesky's method a last pivot, but no base for others.
    EXPECT_LT(SymmetricInverse(a).leastPivot(), 1e-8) << n;
    EXPECT_GT(SymmetricInverse(chain(n, true)).leastPivot(), 1e-3) << n;
  }
}

}  // namespace
}  // namespace squeal::test
