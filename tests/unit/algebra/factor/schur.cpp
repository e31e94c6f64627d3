// SPDX-License-Identifier: BSD-2-Clause
// The Schur complement of a chain of unit springs between two walls: the springs between the nodes
// that are kept are in series, with the stiffness 1/distance.
#include "algebra/factor/schur.hpp"

#include <gtest/gtest.h>

#include "base/system/concatenation.hpp"
#include "support/algebra/chain.hpp"

namespace squeal::test {
namespace {

TEST(SchurComplement, OfAChainIsOneOfLongerSprings) {
  const std::vector<PetscInt> kept{180, 3, 4, 61, 199, 120, 90};
  for (const bool lastIsEmpty : {false, true}) {
    const OwnedMat matrix = chain(0, lastIsEmpty);
    PetscInt first = 0, last = 0;
    check(MatGetOwnershipRange(matrix, &first, &last));
    std::vector<PetscInt> own;
    for (const PetscInt row : kept)
      if (row >= first && row < last) own.push_back(row);
    const auto found = factor::schurComplement(matrix, own);
    const auto all = Concatenation(PETSC_COMM_WORLD, own.size()).gathered(own);
    ASSERT_EQ(found.rows(), std::ssize(own));
    ASSERT_EQ(found.columns(), std::ssize(kept));
    auto sorted = all;
    std::ranges::sort(sorted);
    const auto place = [&](PetscInt row) {
      return std::ranges::find(sorted, row) - sorted.begin();
    };
    // The distance to the neighbour before or after that is kept, or to the wall.
    const auto gap = [&](std::ptrdiff_t k) {
      const PetscInt from = k == 0 ? -1 : sorted[k - 1],
                     to = k == std::ssize(sorted) ? chainOrder : sorted[k];
      return double(to - from);
    };
    for (PetscInt i = 0; i < found.rows(); ++i)
      for (PetscInt j = 0; j < found.columns(); ++j) {
        const auto a = place(own[i]), b = place(all[j]);
        const double exact = a == b                 ? 1 / gap(a) + 1 / gap(a + 1)
                             : std::abs(a - b) == 1 ? -1 / gap(std::max(a, b))
                                                    : 0;
        EXPECT_NEAR(found(i, j), exact, 1e-13) << own[i] << " " << all[j];
      }
  }
}

}  // namespace
}  // namespace squeal::test
