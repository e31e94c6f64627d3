// SPDX-License-Identifier: BSD-2-Clause
// Proper orthogonal decomposition: the new basis spans the vectors it was given, and no more.
#include "eigen/reduction/pod.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "algebra/linalg/block.hpp"
#include "eigen/pencil/pencil.hpp"
#include "problem/terms/terms.hpp"
#include "support/problem/coarse_layers.hpp"

namespace squeal {
namespace {

using linalg::DenseMatrix;

struct Fixture : test::Layers {
  pencil::Pencil pencil;
  modes::Modes free;
  reduction::ProjectedBasis basis;
  reduction::PointProblem problem;
  Fixture()
      : Layers("-modes_count 12"),
        pencil(terms::affineTerms(model.contact, *system)),
        free(modes()),
        basis(pencil, *system, free, {}),
        problem{{0.3}, pencil.with({})} {
    basis.addSet(pencil, {});
  }
  /// A solved point with these right vectors.
  std::vector<reduction::PointState> solved(const std::vector<std::vector<Complex>>& vectors) {
    std::vector<reduction::PointState> states;
    states.push_back(basis.state(problem, {}));
    for (const auto& q : vectors) states[0].solution.spectrum.band.push_back({{0, 1}, q});
    return states;
  }
};

/// Collective. Returns the distance of a column from the span of the two columns of V, relative to
/// its length.
double distance(MPI_Comm comm, const linalg::DenseView& column, const linalg::Block& v) {
  const DenseMatrix gram = linalg::transposedProduct(comm, v, v),
                    along = linalg::transposedProduct(comm, v, column);
  const double determinant = gram(0, 0) * gram(1, 1) - gram(0, 1) * gram(1, 0);
  DenseMatrix coefficients(2, 1);
  coefficients(0, 0) = (gram(1, 1) * along(0, 0) - gram(0, 1) * along(1, 0)) / determinant;
  coefficients(1, 0) = (gram(0, 0) * along(1, 0) - gram(1, 0) * along(0, 0)) / determinant;
  DenseMatrix rest(column);
  linalg::addScaled(rest, -1, linalg::product(v, coefficients));
  return linalg::length(comm, rest.column(0)) / linalg::length(comm, column.column(0));
}

TEST(Pod, WithoutPairsNothingChanges) {
  Fixture f;
  const PetscInt size = f.basis.basis().size();
  reduction::Pod pod;
  EXPECT_FALSE(pod.compress(f.basis));
  EXPECT_EQ(f.basis.basis().size(), size);
}

// The real and imaginary parts of three vectors lie in one plane, except for 1e-12, which is below
// the limit of 1e-9. A vector may be shorter than the basis, as after corrections.
TEST(Pod, SpansTheVectorsOfAllPoints) {
  Fixture f;
  const MPI_Comm comm = f.basis.basis().comm();
  const linalg::Block before = f.basis.basis().columns();
  ASSERT_EQ(before.columns(), 12);
  const double half = std::sqrt(0.5);
  std::vector<Complex> third(12);
  third[0] = 1, third[5] = 1e-12;
  auto states = f.solved({{half, {0, half}}, {half, -half}});
  auto more = f.solved({third});
  reduction::Pod pod;
  pod.take(states);
  pod.take(more);
  ASSERT_TRUE(pod.compress(f.basis));
  const linalg::Block after = f.basis.basis().columns();
  ASSERT_EQ(after.columns(), 2);
  // Round-off, and 1e-12 of the vector that is left out.
  for (PetscInt j = 0; j < 2; ++j)
    EXPECT_LT(distance(comm, before.columnRange(j, j + 1), after), 1e-11);
  for (PetscInt j = 2; j < 12; ++j)  // K0-orthogonal to both: not in their span
    EXPECT_GT(distance(comm, before.columnRange(j, j + 1), after), 0.01);
  // Orthonormal combinations of orthonormal vectors, in the energy of K0; the free modes are so to
  // the square root of their tolerance.
  linalg::Block forces(after.rows());
  linalg::appendProduct(f.basis.basis().stiffness(), after, forces);
  const DenseMatrix energy = linalg::transposedProduct(comm, after, forces);
  for (PetscInt j = 0; j < 2; ++j)
    for (PetscInt i = 0; i < 2; ++i) EXPECT_NEAR(energy(i, j), i == j, 1e-6);
  // The vectors of earlier points have turned with the basis.
  ASSERT_TRUE(pod.compress(f.basis));
  ASSERT_EQ(f.basis.basis().size(), 2);
  for (PetscInt j = 0; j < 2; ++j)
    EXPECT_LT(distance(comm, before.columnRange(j, j + 1), f.basis.basis().columns()), 1e-11);
}

// A component above the limit adds a direction.
TEST(Pod, KeepsSmallComponents) {
  Fixture f;
  std::vector<Complex> q(12);
  q[0] = 1, q[5] = {0, 1e-7};
  auto states = f.solved({q});
  reduction::Pod pod;
  pod.take(states);
  ASSERT_TRUE(pod.compress(f.basis));
  EXPECT_EQ(f.basis.basis().size(), 2);
}

}  // namespace
}  // namespace squeal
