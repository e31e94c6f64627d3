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
    const auto found = factor::schurComplement(matrix.share(), own);
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

/// Returns the stiffness of unit springs between the neighbours of a grid of `deep` layers of
/// `wide` × `wide` nodes, numbered layer by layer.
OwnedMat grid(PetscInt deep, PetscInt wide) {
  const PetscInt layer = wide * wide, size = deep * layer;
  OwnedMat matrix;
  check(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, size, size, 7, nullptr, 6,
                     nullptr, matrix.out()));
  PetscInt first = 0, last = 0;
  check(MatGetOwnershipRange(matrix, &first, &last));
  for (PetscInt i = first; i < last; ++i) {
    const PetscInt x = i % wide, y = i / wide % wide, z = i / layer;
    double sum = 0;
    const auto spring = [&](bool exists, PetscInt j) {
      if (!exists) return;
      check(MatSetValue(matrix, i, j, -1, INSERT_VALUES));
      ++sum;
    };
    spring(x > 0, i - 1), spring(x + 1 < wide, i + 1);
    spring(y > 0, i - wide), spring(y + 1 < wide, i + wide);
    spring(z > 0, i - layer), spring(z + 1 < deep, i + layer);
    check(MatSetValue(matrix, i, i, sum, INSERT_VALUES));
  }
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

// The first and the last layer of a grid are kept. If one of them moves as a whole, the springs
// between them are in series: the force on each node of a layer is ±1/(number of springs). MUMPS
// divides the last front, of 800 unknowns, among the ranks.
TEST(SchurComplement, OfTwoFacesOfAGrid) {
  constexpr PetscInt deep = 10, wide = 20, layer = wide * wide;
  const OwnedMat matrix = grid(deep, wide);
  PetscInt first = 0, last = 0;
  check(MatGetOwnershipRange(matrix, &first, &last));
  std::vector<PetscInt> own;
  for (PetscInt row = first; row < last; ++row)
    if (row < layer || row >= (deep - 1) * layer) own.push_back(row);
  testing::internal::CaptureStderr();
  const auto found = factor::schurComplement(matrix.share(), own);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  const auto all = Concatenation(PETSC_COMM_WORLD, own.size()).gathered(own);
  ASSERT_EQ(found.columns(), 2 * layer);
  for (PetscInt i = 0; i < found.rows(); ++i) {
    double force = 0, rigid = 0;
    for (PetscInt j = 0; j < found.columns(); ++j) {
      rigid += found(i, j);
      if (all[j] >= layer) force += found(i, j);
    }
    EXPECT_NEAR(rigid, 0, 1e-12);
    EXPECT_NEAR(force, (own[i] < layer ? -1.0 : 1.0) / (deep - 1), 1e-12);
  }
}

}  // namespace
}  // namespace squeal::test
