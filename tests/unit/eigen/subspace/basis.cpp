// SPDX-License-Identifier: BSD-2-Clause
// The growing basis of the reduced problem: orthonormal in the energy of K0, whatever is added.
#include "eigen/subspace/basis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "support/algebra/blocks.hpp"
#include "support/algebra/dense.hpp"
#include "support/problem/coarse_layers.hpp"

namespace squeal {
namespace {

/// Twenty modes of the layers are the basis to begin with.
struct Fixture : test::Layers {
  std::unique_ptr<subspace::Basis> basis;
  Fixture() : Layers("-modes_count 20") {
    const auto free = modes();  // before the solver is asked for: they leave it with other matrices
    basis = std::make_unique<subspace::Basis>(free, *system);
  }

  /// K0 X.
  linalg::Block forcesOf(const linalg::Block& x) const { return test::times(system->k0(), x); }

  /// V.
  const linalg::Block& columns() const { return basis->columns(); }

  /// The largest entry of VᵀK0V − I.
  double departure() const {
    EXPECT_EQ(columns().columns(), basis->size());
    return test::largestDifference(
        linalg::transposedProduct(basis->comm(), columns(), forcesOf(columns())),
        test::identity(basis->size()));
  }

  linalg::Block random(PetscInt count, unsigned seed) const {
    linalg::Block block(basis->localRows(), count);
    int rank = 0;
    check(MPI_Comm_rank(basis->comm(), &rank));
    std::mt19937 generator(seed + 100 * static_cast<unsigned>(rank));
    for (double& entry : block.entries()) entry = test::uniform(generator);
    return block;
  }
};

// Rounding of a few sums, times the square root of the condition number of K0, some hundreds.
TEST(Basis, StaysOrthonormalInEnergy) {
  const Fixture f;
  EXPECT_EQ(f.basis->size(), 20);
  EXPECT_LT(f.departure(), 1e-10);
  for (const PetscInt count : {7, 1, 30, 12}) {
    const PetscInt before = f.basis->size();
    EXPECT_EQ(f.basis->add(f.random(count, count)), count);
    EXPECT_EQ(f.basis->size(), before + count);
  }
  test::print("basis of %d: departure from orthonormality %.1e\n",
              static_cast<int>(f.basis->size()), f.departure());
  EXPECT_LT(f.departure(), 1e-10);
  EXPECT_EQ(f.basis->solves(), 50);
  EXPECT_LT(test::largestDifference(f.basis->sketched(), f.basis->sketch().unweighted(f.columns())),
            1e-12);
}

// The basis gains K0⁻¹ R: K0 V Vᵀr = r for a residual that has gone in.
TEST(Basis, HoldsWhatIsAdded) {
  const Fixture f;
  const linalg::Block residuals = f.random(5, 1);
  f.basis->add(residuals);
  linalg::Block left = residuals;
  linalg::multiplyAdd(f.forcesOf(f.columns()),
                      linalg::transposedProduct(f.basis->comm(), f.columns(), residuals), left, -1);
  EXPECT_LT(test::largestOfAll(left), 1e-10);  // of entries up to 1
}

// VᵀK0V and K0 V of what is added, known without products with K0: those of the products, to the
// rounding of StaysOrthonormalInEnergy. Residuals of a Galerkin solution have Vᵀr = 0 to some
// digits; others are made orthogonal first.
TEST(Basis, KnowsEnergiesAndForcesOfWhatIsAdded) {
  const Fixture f;
  const auto check = [&](PetscInt count, double departure) {
    const PetscInt size = f.basis->size(), old = size - count;
    const linalg::Block forces = f.forcesOf(f.columns());
    const linalg::DenseMatrix gram =
        linalg::transposedProduct(f.basis->comm(), f.columns(), forces);
    ASSERT_EQ(f.basis->forces().columns(), count);
    ASSERT_EQ(f.basis->energies().columns(), count);
    linalg::Block wrong = f.basis->forces();
    linalg::addScaled(wrong, -1, forces.columnRange(old, size));
    EXPECT_LT(test::largestOfAll(wrong), 1e-10 * test::largestOfAll(forces));
    EXPECT_LT(test::largestDifference(f.basis->energies(), gram.columnRange(old, size)), 1e-10);
    const linalg::DenseMatrix unit = test::identity(size);
    const double off = test::largestDifference(linalg::DenseMatrix(gram.columnRange(old, size)),
                                               unit.columnRange(old, size));
    EXPECT_LT(off, 1e-3);
    EXPECT_GT(off, departure);
  };
  linalg::Block residuals = f.random(6, 8);
  // R − (1 − 1e-5) K0 V VᵀR: a hundred-thousandth of the part along V is left, and stays in the
  // basis.
  linalg::multiplyAdd(f.forcesOf(f.columns()),
                      linalg::transposedProduct(f.basis->comm(), f.columns(), residuals), residuals,
                      -1 + 1e-5);
  EXPECT_EQ(f.basis->add(residuals), 6);
  check(6, 1e-8);
  EXPECT_EQ(f.basis->add(f.random(4, 9)), 4);
  check(4, 0);
}

TEST(Basis, DropsWhatItHasAndWhatDependsOnOthers) {
  const Fixture f;
  linalg::Block twice = f.random(3, 2);
  const linalg::Block copy = twice;
  twice.append(copy);
  for (PetscInt i = 0; i < twice.rows(); ++i) twice(i, 4) = 2 * twice(i, 0) - 3 * twice(i, 2);
  EXPECT_EQ(f.basis->add(twice), 3);
  EXPECT_EQ(f.basis->add(copy), 0);                     // they are in the basis
  EXPECT_EQ(f.basis->add(f.forcesOf(f.columns())), 0);  // K0 V
  EXPECT_EQ(f.basis->add(linalg::Block(f.basis->localRows())), 0);
  EXPECT_EQ(f.basis->size(), 23);
  EXPECT_LT(f.departure(), 1e-10);
}

// Nothing is left of K0 V where V is orthonormal only to some digits, so that the basis never
// holds more vectors than there are unknowns.
TEST(Basis, DropsWhatItHasWhereItIsLessOrthonormal) {
  for (const double along : {3e-5, 1e-4, 3e-4, 1e-3}) {
    const Fixture f;
    for (unsigned batch = 0; batch < 5; ++batch) {
      linalg::Block residuals = f.random(4, 8 + batch);
      linalg::multiplyAdd(f.forcesOf(f.columns()),
                          linalg::transposedProduct(f.basis->comm(), f.columns(), residuals),
                          residuals, -1 + along);
      f.basis->add(residuals);
    }
    test::print("departure from orthonormality %.1e\n", f.departure());
    EXPECT_EQ(f.basis->size(), 40);
    EXPECT_EQ(f.basis->add(f.forcesOf(f.columns())), 0);
  }
}

// With VᵀK0V known, one pass makes responses orthogonal to V to the rounding of
// StaysOrthonormalInEnergy, though V is orthonormal only to a few digits.
TEST(Basis, MakesResponsesOrthogonalWithKnownEnergies) {
  const Fixture f;
  linalg::Block residuals = f.random(4, 8);
  linalg::multiplyAdd(f.forcesOf(f.columns()),
                      linalg::transposedProduct(f.basis->comm(), f.columns(), residuals), residuals,
                      -1 + 1e-5);
  f.basis->add(residuals);
  EXPECT_GT(f.departure(), 1e-8);
  const auto energies =
      linalg::transposedProduct(f.basis->comm(), f.columns(), f.forcesOf(f.columns()));
  const linalg::Block forces = f.random(6, 9);
  const double ratio = f.basis->lastEnergyRatio();
  const auto flexibility = f.basis->flexibility(forces);
  EXPECT_LT(test::largestDifference(f.basis->addResponses(forces, energies), flexibility),
            1e-10 * test::largestOfAll(flexibility));
  ASSERT_EQ(f.basis->energies().columns(), 6);
  const linalg::DenseMatrix along = linalg::rowRange(f.basis->energies(), 0, 24);
  EXPECT_LT(test::largestOfAll(along), 1e-10);
  EXPECT_EQ(f.basis->lastEnergyRatio(), ratio);
}

TEST(Basis, CombinationsStayOrthonormal) {
  const Fixture f;
  f.basis->add(f.random(10, 3));
  // Eigenvectors of a symmetric matrix: orthonormal. Twelve of them.
  linalg::DenseMatrix turned(30, 30);
  for (PetscInt j = 0; j < 30; ++j)
    for (PetscInt i = 0; i < 30; ++i) turned(i, j) = std::cos((i + 1) * (j + 1));
  linalg::symmetricEigen(turned);
  turned.resizeColumns(12);
  f.basis->combine(turned);
  EXPECT_EQ(f.basis->size(), 12);
  EXPECT_LT(f.departure(), 1e-10);
}

// One column: √(rᵀK0⁻¹r) / √(rᵀ diag(K0)⁻¹ r). Two: the root of the largest eigenvalue of the
// pencil of both products. The solution of the first one is another solver's.
TEST(Basis, EnergyRatiosAreWhatTheySay) {
  const Fixture f;
  const linalg::Block one = f.random(1, 4), two = f.random(2, 5);
  OwnedVec diagonal;
  check(MatCreateVecs(f.system->k0(), diagonal.out(), nullptr));
  check(MatGetDiagonal(f.system->k0(), diagonal));
  const Mat k0 = f.system->k0();
  const auto products = [&](const linalg::Block& x) {  // XᵀK0⁻¹X and XᵀD⁻¹X
    const auto solved = test::mapped(k0, x, [&](Vec b, Vec u) { test::solveDirectly(k0, b, u); });
    const auto divided =
        test::mapped(k0, x, [&](Vec b, Vec u) { check(VecPointwiseDivide(u, b, diagonal)); });
    return std::pair{linalg::transposedProduct(f.basis->comm(), x, solved),
                     linalg::transposedProduct(f.basis->comm(), x, divided)};
  };
  const auto found = f.basis->energyRatios({one, two, linalg::Block(one.rows())});
  ASSERT_EQ(found.size(), 3U);
  const auto [energy, weighted] = products(one);
  EXPECT_NEAR(found[0], std::sqrt(energy(0, 0) / weighted(0, 0)), 1e-10 * found[0]);
  auto [energies, weights] = products(two);
  const double largest = std::sqrt(linalg::symmetricEigen(energies, weights).back());
  EXPECT_NEAR(found[1], largest, 1e-10 * largest);
  EXPECT_EQ(found[2], 0);
  EXPECT_EQ(f.basis->size(), 20);  // nothing is added
  EXPECT_EQ(f.basis->solves(), 3);
  f.basis->add(two);
  EXPECT_NEAR(f.basis->lastEnergyRatio(), largest, 1e-10 * largest);
  test::print("energy ratios %.4f and %.4f\n", found[0], found[1]);
}

}  // namespace
}  // namespace squeal
