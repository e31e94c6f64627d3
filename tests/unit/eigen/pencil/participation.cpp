// SPDX-License-Identifier: BSD-2-Clause
// Participations of free modes, for modes that are the unit vectors.
#include "eigen/pencil/participation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/algebra/sparse.hpp"

namespace squeal::test {
namespace {

// K0 = diag(1, 4, 9), M0 = 1: ω = 1, 2, 3. Of x = (1, 2i, 1) at s = 0.3 + 2i, |s|² = 4.09, the
// energy is 4.09 · 6 + (1 + 4·4 + 9) = 50.54, and q = x.
TEST(Participation, IsThatOfOscillators) {
  EntryList stiffness, mass;
  for (PetscInt i = 0; i < 3; ++i) {
    stiffness.emplace_back(i, i, (i + 1.0) * (i + 1));
    mass.emplace_back(i, i, 1.0);
  }
  const factor::AssociatedSystem system(matrixOf(3, stiffness), matrixOf(3, mass), "K0");
  modes::Modes modes;
  check(BVCreate(PETSC_COMM_WORLD, modes.vectors.out()));
  check(BVSetType(modes.vectors, BVSVEC));
  OwnedVec like;
  check(MatCreateVecs(system.k0(), like.out(), nullptr));
  check(BVSetSizesFromVec(modes.vectors, like, 2));
  for (int i = 0; i < 2; ++i) {  // the third mode is not computed
    modes.lambda.push_back((i + 1.0) * (i + 1)), modes.angularFrequency.push_back(i + 1);
    std::vector<double> unit(3, 0.0);
    unit[i] = 1;
    const OwnedVec column = vectorOf(system.k0(), true, unit);
    check(BVInsertVec(modes.vectors, i, column));
  }
  const linalg::ComplexVector x{vectorOf(system.k0(), true, {1, 0, 1}),
                                vectorOf(system.k0(), true, {0, 2, 0})};
  // Nine times the motion, more than one block of columns.
  const std::vector<pencil::ComplexMotion> motions(9, {{0.3, 2}, &x});
  const auto all = pencil::participations(modes, system, motions);
  ASSERT_EQ(all.size(), 9u);
  for (const auto& one : all) EXPECT_NEAR(one.at(1).energy, all[0].at(1).energy, 1e-15);
  const auto& found = all[8];
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].energy, (4.09 + 1) * 1 / 50.54, 1e-14);
  EXPECT_NEAR(found[1].energy, (4.09 + 4) * 4 / 50.54, 1e-14);
  EXPECT_NEAR(found[0].mac, 1 / 6.0, 1e-14);
  EXPECT_NEAR(found[1].mac, 4 / 6.0, 1e-14);
  // The largest amplitude has the phase 0, so that of mode 1 has −90 degrees.
  EXPECT_NEAR(std::abs(found[1].amplitude - 2 / std::sqrt(6)), 0, 1e-14);
  EXPECT_NEAR(std::abs(found[0].amplitude - Complex(0, -1 / std::sqrt(6))), 0, 1e-14);
}

}  // namespace
}  // namespace squeal::test
