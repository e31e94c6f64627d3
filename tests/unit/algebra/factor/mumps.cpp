// SPDX-License-Identifier: BSD-2-Clause
// The factorisation of a chain of springs, whose eigenvalues are known:
//   A = tridiag(−1, 2, −1) of order n,   λ_k = 2 − 2 cos(kπ/(n + 1)).
#include "algebra/factor/mumps.hpp"

#include <gtest/gtest.h>

#include "algebra/factor/symmetric_solver.hpp"
#include "support/algebra/chain.hpp"
#include "support/model/model.hpp"

namespace squeal::test {
namespace {

double eigenvalue(int k) { return 2 - 2 * std::cos(k * M_PI / (chainOrder + 1)); }

/// Collective. Returns the largest error of A⁻¹ (A X) over all ranks, X with 3 columns of the known
/// shapes sin(jkπ/(n + 1)), A X = (λ_k − shift) X.
double errorOfSolves(factor::MumpsFactor& factor, Mat matrix, double shift) {
  PetscInt first = 0, last = 0;
  check(MatGetOwnershipRange(matrix, &first, &last));
  const PetscInt rows = last - first;
  std::vector<double> b(3 * rows), x(3 * rows);
  const auto shape = [&](PetscInt i, int k) {
    return std::sin((first + i + 1) * k * M_PI / (chainOrder + 1));
  };
  for (int k = 1; k <= 3; ++k)
    for (PetscInt i = 0; i < rows; ++i)
      b[(k - 1) * rows + i] = (eigenvalue(k) - shift) * shape(i, k);
  factor.solve(b.data(), x.data(), 3);
  double worst = 0;
  for (int k = 1; k <= 3; ++k)
    for (PetscInt i = 0; i < rows; ++i)
      worst = std::max(worst, std::abs(x[(k - 1) * rows + i] - shape(i, k)));
  check(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  return worst;
}

// The smallest |λ − shift| is 2e-3, so that rounding grows to some 1e-13.
TEST(Mumps, SolvesAndCounts) {
  setOptions("");
  for (const bool lastIsEmpty : {false, true}) {
    const double shift = 0.5 * (eigenvalue(57) + eigenvalue(58));
    const OwnedMat definite = chain(0, lastIsEmpty), shifted = chain(shift, lastIsEmpty);
    factor::MumpsFactor first(PETSC_COMM_WORLD, "");
    first.analyse(definite);
    EXPECT_EQ(first.factorise(definite), "");
    EXPECT_LT(errorOfSolves(first, definite, 0), 1e-11);
    EXPECT_LT(errorOfSolves(first, definite, 0), 1e-11);  // the scatter is made already
    factor::MumpsFactor second(PETSC_COMM_WORLD, "");
    second.enableInertia();
    second.analyse(shifted, &first);
    EXPECT_EQ(second.infog(7), 1) << "the order that is handed over";
    EXPECT_EQ(second.factorise(shifted), "");
    EXPECT_EQ(second.inertia().negative, 57);
    EXPECT_LT(errorOfSolves(second, shifted, shift), 1e-11);
    EXPECT_EQ(factor::inertia(shifted).negative, 57);
  }
}

// With other values of the same pattern one analysis serves.
TEST(Mumps, FactorisesAnew) {
  setOptions("");
  factor::MumpsFactor factor(PETSC_COMM_WORLD, "");
  factor.analyse(chain(0));
  for (const double shift : {0.0, -1.0, -2.0}) {
    const OwnedMat matrix = chain(shift);
    EXPECT_EQ(factor.factorise(matrix), "");
    EXPECT_LT(errorOfSolves(factor, matrix, shift), 1e-11);
  }
}

TEST(Mumps, KeepsItsFactorOnDisk) {
  setOptions("-disk_mat_mumps_icntl_22 1");
  const OwnedMat matrix = chain(0);
  factor::MumpsFactor factor(PETSC_COMM_WORLD, "disk_");
  factor.analyse(matrix);
  EXPECT_EQ(factor.factorise(matrix), "");
  EXPECT_LT(errorOfSolves(factor, matrix, 0), 1e-11);
}

TEST(Mumps, NamesAFolderThatIsNotThere) {
  setOptions("-disk_mat_mumps_icntl_22 1 -disk_mat_mumps_ooc_tmpdir /nowhere/at/all");
  const OwnedMat matrix = chain(0);
  factor::MumpsFactor factor(PETSC_COMM_WORLD, "disk_");
  factor.analyse(matrix);
  const std::string why = factor.factorise(matrix);
  EXPECT_NE(why.find("/nowhere/at/all"), std::string::npos) << why;
  EXPECT_NE(why.find("-…_mat_mumps_ooc_tmpdir"), std::string::npos) << why;
}

}  // namespace
}  // namespace squeal::test
