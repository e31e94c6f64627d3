// The growing basis of the reduced problem: orthonormal in the energy of K0, whatever is added.
#include "reduction/basis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "linalg/block.hpp"
#include "linalg/quadratic.hpp"
#include "linalg/symmetric.hpp"
#include "support/layers.hpp"

namespace squeal {
namespace {

using linalg::Block;
using reduction::Basis;

/// Twenty modes of the layers are the basis to begin with.
struct Fixture : test::Layers {
  std::unique_ptr<reduction::Basis> basis;
  Fixture() : Layers("-modes_count 20") {
    const auto free = modes();  // before the solver is asked for: they leave it with other matrices
    basis = std::make_unique<reduction::Basis>(free, *system);
  }

  /// A X.
  linalg::Block times(Mat matrix, const linalg::Block& x) const {
    OwnedVec from, to;
    check(MatCreateVecs(matrix, from.out(), to.out()));
    linalg::Block result(x.rows);
    for (PetscInt j = 0; j < x.columns; ++j) {
      PetscScalar* entries = nullptr;
      check(VecGetArray(from, &entries));
      std::copy_n(x.column(j), x.rows, entries);
      check(VecRestoreArray(from, &entries));
      check(MatMult(matrix, from, to));
      const PetscScalar* product = nullptr;
      check(VecGetArrayRead(to, &product));
      result.append(product);
      check(VecRestoreArrayRead(to, &product));
    }
    return result;
  }

  /// V.
  const linalg::Block& columns() const { return basis->columns(); }

  /// The largest entry of VᵀK0V − I.
  double departure() const {
    const linalg::Block v = columns();
    EXPECT_EQ(v.columns, basis->size());
    const auto gram = linalg::transposedProduct(basis->comm(), v, times(system->k0(), v));
    double worst = 0;
    for (std::size_t k = 0; k < gram.size(); ++k) {
      const bool diagonal = k % (static_cast<std::size_t>(v.columns) + 1) == 0;
      worst = std::max(worst, std::abs(gram[k] - (diagonal ? 1 : 0)));
    }
    return worst;
  }

  linalg::Block random(PetscInt count, unsigned seed) const {
    linalg::Block block(basis->localRows(), count);
    int rank = 0;
    check(MPI_Comm_rank(basis->comm(), &rank));
    std::mt19937 generator(seed + 100 * static_cast<unsigned>(rank));
    for (auto& value : block.values)
      value = 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1;
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
    EXPECT_EQ(f.basis->add(f.random(count, static_cast<unsigned>(count))), count);
    EXPECT_EQ(f.basis->size(), before + count);
  }
  test::print("basis of %d: departure from orthonormality %.1e\n",
              static_cast<int>(f.basis->size()), f.departure());
  EXPECT_LT(f.departure(), 1e-10);
  EXPECT_EQ(f.basis->solves(), 50);
  const linalg::Block v = f.columns();
  const auto sketch = f.basis->sketch().unweighted(v.values.data(), v.columns);
  ASSERT_EQ(sketch.size(), f.basis->sketched().size());
  for (std::size_t k = 0; k < sketch.size(); ++k)
    EXPECT_NEAR(f.basis->sketched()[k], sketch[k], 1e-12) << k;
}

// The basis gains K0⁻¹ R: K0 V Vᵀr = r for a residual that has gone in.
TEST(Basis, HoldsWhatIsAdded) {
  const Fixture f;
  const linalg::Block residuals = f.random(5, 1);
  f.basis->add(residuals);
  const linalg::Block v = f.columns(), forces = f.times(f.system->k0(), v);
  const auto parts = linalg::transposedProduct(f.basis->comm(), v, residuals);
  linalg::Block left = residuals;
  linalg::multiplyAdd(forces.values.data(), forces.rows, forces.columns, parts, left.values, -1);
  double worst = 0;
  for (const double value : left.values) worst = std::max(worst, std::abs(value));
  EXPECT_LT(test::largest(worst), 1e-10);  // of entries up to 1
}

// VᵀK0V and K0 V of what is added, known without products with K0: those of the products, to the
// rounding of StaysOrthonormalInEnergy. Residuals of a Galerkin solution have Vᵀr = 0 to some
// digits; others are made orthogonal first, and their K0 z is not kept.
TEST(Basis, KnowsEnergiesAndForcesOfWhatIsAdded) {
  const Fixture f;
  const auto check = [&](bool kept, PetscInt count, double departure) {
    const PetscInt size = f.basis->size();
    const linalg::Block forces = f.times(f.system->k0(), f.columns());
    ASSERT_EQ(f.basis->forces().columns, kept ? count : 0);
    double worst = 0;
    for (PetscInt j = 0; j < f.basis->forces().columns; ++j)
      for (PetscInt i = 0; i < forces.rows; ++i)
        worst = std::max(
            worst, std::abs(f.basis->forces().column(j)[i] - forces.column(size - count + j)[i]));
    double scale = 0;
    for (const double value : forces.values) scale = std::max(scale, std::abs(value));
    EXPECT_LT(test::largest(worst), 1e-10 * test::largest(scale));
    const auto gram = linalg::transposedProduct(f.basis->comm(), f.columns(), forces);
    const auto& energies = f.basis->energies();
    ASSERT_EQ(energies.size(), static_cast<std::size_t>(kept ? size * count : 0));
    double known = 0, off = 0;
    for (PetscInt j = size - count; j < size; ++j)
      for (PetscInt i = 0; i < size; ++i) {
        const double entry = gram[j * size + i];
        if (kept)
          known = std::max(known, std::abs(energies[(j - size + count) * size + i] - entry));
        off = std::max(off, std::abs(entry - (i == j ? 1 : 0)));
      }
    EXPECT_LT(known, 1e-10);
    EXPECT_LT(off, 1e-3);
    EXPECT_GT(off, departure);
  };
  linalg::Block residuals = f.random(6, 8);
  const auto parts = linalg::transposedProduct(f.basis->comm(), f.columns(), residuals);
  const linalg::Block forces = f.times(f.system->k0(), f.columns());
  // R − (1 − 1e-5) K0 V VᵀR: a hundred-thousandth of the part along V is left, and stays in the
  // basis.
  linalg::multiplyAdd(forces.values.data(), forces.rows, forces.columns, parts, residuals.values,
                      -1 + 1e-5);
  EXPECT_EQ(f.basis->add(residuals), 6);
  check(true, 6, 1e-8);
  EXPECT_EQ(f.basis->add(f.random(4, 9)), 4);
  check(false, 4, 0);
}

TEST(Basis, DropsWhatItHasAndWhatDependsOnOthers) {
  const Fixture f;
  linalg::Block twice = f.random(3, 2);
  const linalg::Block copy = twice;
  append(twice, copy);
  for (PetscInt i = 0; i < twice.rows; ++i)
    twice.column(4)[i] = 2 * twice.column(0)[i] - 3 * twice.column(2)[i];
  EXPECT_EQ(f.basis->add(twice), 3);
  EXPECT_EQ(f.basis->add(copy), 0);                                  // they are in the basis
  EXPECT_EQ(f.basis->add(f.times(f.system->k0(), f.columns())), 0);  // K0 V
  EXPECT_EQ(f.basis->add(linalg::Block(f.basis->localRows())), 0);
  EXPECT_EQ(f.basis->size(), 23);
  EXPECT_LT(f.departure(), 1e-10);
}

TEST(Basis, CombinationsStayOrthonormal) {
  const Fixture f;
  f.basis->add(f.random(10, 3));
  // Eigenvectors of a symmetric matrix: orthonormal. Twelve of them.
  linalg::DenseMatrix turned(30 * 30);
  for (std::size_t k = 0; k < turned.size(); ++k)
    turned[k] = std::cos(static_cast<double>((k / 30 + 1) * (k % 30 + 1)));
  linalg::symmetricEigen(turned, 30);
  turned.resize(30 * 12);
  f.basis->combine(turned, 12);
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
  const auto products = [&](const linalg::Block& x) {  // XᵀK0⁻¹X and XᵀD⁻¹X
    OwnedVec from, to;
    check(MatCreateVecs(f.system->k0(), from.out(), to.out()));
    linalg::Block solved(x.rows), divided(x.rows);
    for (PetscInt j = 0; j < x.columns; ++j) {
      for (linalg::Block* result : {&solved, &divided}) {
        PetscScalar* entries = nullptr;
        check(VecGetArray(from, &entries));
        std::copy_n(x.column(j), x.rows, entries);
        check(VecRestoreArray(from, &entries));
        if (result == &solved)
          test::solveDirectly(f.system->k0(), from, to);
        else
          check(VecPointwiseDivide(to, from, diagonal));
        const PetscScalar* values = nullptr;
        check(VecGetArrayRead(to, &values));
        result->append(values);
        check(VecRestoreArrayRead(to, &values));
      }
    }
    return std::pair{linalg::transposedProduct(f.basis->comm(), x, solved),
                     linalg::transposedProduct(f.basis->comm(), x, divided)};
  };
  const auto found = f.basis->energyRatios({one, two, linalg::Block(one.rows)});
  ASSERT_EQ(found.size(), 3U);
  const auto [energy, weighted] = products(one);
  EXPECT_NEAR(found[0], std::sqrt(energy[0] / weighted[0]), 1e-10 * found[0]);
  auto [energies, weights] = products(two);
  const double largest = std::sqrt(linalg::symmetricEigen(energies, weights, 2).back());
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
