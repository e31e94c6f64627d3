// SPDX-License-Identifier: BSD-2-Clause
// The blocks of a point from static responses, against those computed from all unknowns.
#include <gtest/gtest.h>

#include <random>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/error.hpp"
#include "eigen/completeness/point_bounds.hpp"
#include "eigen/proof/count.hpp"
#include "eigen/proof/expansion.hpp"
#include "support/algebra/dense.hpp"
#include "support/eigen/split_brake.hpp"

namespace {

using namespace squeal;
using linalg::DenseMatrix;

/// A brake in coordinates in which K0 = 1 and M0 = diag(1/ω²).
struct Brake {
  std::vector<double> omega;          // ascending
  DenseMatrix slip, normal, inertia;  // S, N_0, N_2
  PetscInt size() const { return std::ssize(omega); }
};

Brake randomBrake(PetscInt n, PetscInt rows, std::mt19937& generator) {
  Brake brake;
  std::exponential_distribution<double> gap(1);
  std::normal_distribution<double> normal;
  double frequency = 1;
  for (PetscInt j = 0; j < n; ++j) brake.omega.push_back(frequency += 0.1 + gap(generator));
  const auto row = [&](double size) {
    DenseMatrix result(rows, n);
    for (PetscInt j = 0; j < n; ++j)
      for (PetscInt i = 0; i < rows; ++i) result(i, j) = size * normal(generator) / brake.omega[j];
    return result;
  };
  brake.slip = row(2);
  brake.normal = row(2);
  brake.inertia = row(2 / (brake.omega[n / 2] * brake.omega[n / 2]));
  return brake;
}

DenseMatrix timesTransposed(const DenseMatrix& a, const DenseMatrix& b) {
  return linalg::product(a, linalg::transposed(b));
}

/// V, which is orthonormal only within 10⁻³: the lowest modes except one, two vectors as
/// corrections give them, and responses to S.
DenseMatrix basisOf(const Brake& brake, PetscInt modes, PetscInt without, std::mt19937& generator) {
  DenseMatrix basis(brake.size());
  std::vector<double> column(brake.size());
  const auto unit = [&](PetscInt j) {
    std::ranges::fill(column, 0.0);
    column[j] = 1;
    return std::span<const double>(column);
  };
  for (PetscInt j = 0; j < modes; ++j)
    if (j != without) basis.append(unit(j));
  const PetscInt count = basis.columns();
  DenseMatrix others = test::randomMatrix(brake.size(), 2, generator);
  others.append(linalg::transposed(brake.slip));
  for (PetscInt j = 0; j < others.columns(); ++j) {
    for (PetscInt i = 0; i < count; ++i)
      for (PetscInt k = 0; k < brake.size(); ++k)
        if (basis(k, i) == 1) others(k, j) *= 1e-3;  // nearly orthogonal to the modes
    const double size = std::sqrt(linalg::squaredLength(others.column(j)));
    for (double& entry : others.column(j)) entry /= size;
  }
  basis.append(others);
  return basis;
}

/// Returns the matrices of the set, computed as from static responses: the product of M K0⁻¹ M with
/// the responses to S as well, if isSolved.
completeness::SetMatrices matricesOf(const Brake& brake, const DenseMatrix& basis, PetscInt modes,
                                     double theta, bool isSolved = true) {
  completeness::SetMatrices set;
  set.solved = basis.columns() - (isSolved ? 0 : brake.slip.rows());
  set.modes = {0, modes, theta, 0};
  set.energy = linalg::transposedProduct(basis, basis);
  DenseMatrix inertia = basis;
  for (PetscInt j = 0; j < inertia.columns(); ++j)
    for (PetscInt i = 0; i < inertia.rows(); ++i) inertia(i, j) /= brake.omega[i] * brake.omega[i];
  set.mass = linalg::transposedProduct(basis, inertia);
  set.massProduct = linalg::transposedProduct(inertia, inertia);
  for (PetscInt j = set.solved; j < basis.columns(); ++j)
    for (PetscInt i = set.solved; i < basis.columns(); ++i) set.massProduct(i, j) = 0;
  set.slip = {linalg::product(brake.slip, basis)};
  set.slipFlexibility = {timesTransposed(brake.slip, brake.slip)};
  set.normal = linalg::product(brake.normal, basis);
  set.inertia = linalg::product(brake.inertia, basis);
  set.normalFlexibility = timesTransposed(brake.normal, brake.normal);
  set.inertiaFlexibility = timesTransposed(brake.inertia, brake.inertia);
  return set;
}

/// Returns W of all of V.
DenseMatrix allOf(const DenseMatrix& basis) {
  DenseMatrix unit(basis.columns(), basis.columns());
  for (PetscInt i = 0; i < unit.rows(); ++i) unit(i, i) = 1;
  return unit;
}

/// Returns P of all unknowns, K and M.
linalg::DenseProblem fullProblem(const Brake& brake, double friction) {
  linalg::DenseProblem problem;
  problem.stiffness = DenseMatrix(brake.size(), brake.size());
  problem.mass = problem.stiffness;
  for (PetscInt j = 0; j < brake.size(); ++j) {
    problem.stiffness(j, j) = 1;
    problem.mass(j, j) = 1 / (brake.omega[j] * brake.omega[j]);
  }
  linalg::addScaled(problem.stiffness, friction,
                    linalg::transposedProduct(brake.slip, brake.normal));
  linalg::addScaled(problem.mass, friction, linalg::transposedProduct(brake.slip, brake.inertia));
  return problem;
}

completeness::PointBounds boundsOf(const Brake& brake, const DenseMatrix& basis,
                                   const completeness::SetBounds& set, double friction,
                                   const DenseMatrix& w) {
  const auto full = fullProblem(brake, friction);
  completeness::PointMatrices point;
  point.problem.stiffness = linalg::congruent(full.stiffness, basis);
  point.problem.mass = linalg::congruent(full.mass, basis);
  point.slipFactors = {friction};
  return completeness::pointBounds(set, point, w);
}

/// Returns the exact couplings in coordinates of an orthonormal complement of V.
proof::KeptProblem exactBlocks(const Brake& brake, const DenseMatrix& basis, double friction) {
  const PetscInt n = brake.size(), kept = basis.columns();
  DenseMatrix vectors = timesTransposed(
      linalg::product(basis, linalg::inverseTransposed(
                                 linalg::choleskyFactor(linalg::transposedProduct(basis, basis)))),
      linalg::product(basis, linalg::inverseTransposed(
                                 linalg::choleskyFactor(linalg::transposedProduct(basis, basis)))));
  linalg::symmetricEigen(vectors);  // of the projector: the eigenvalue 0 comes first
  const DenseMatrix c(vectors.columnRange(0, n - kept));
  const auto full = fullProblem(brake, friction);
  proof::KeptProblem problem;
  proof::Coupling to, from;
  const std::array matrices{&full.stiffness, &full.mass};
  for (int i = 0; i < 2; ++i) {
    problem.matrices[2 * i] = linalg::congruent(*matrices[i], basis);
    to.coefficients[2 * i] = linalg::transposedProduct(c, linalg::product(*matrices[i], basis));
    from.coefficients[2 * i] = linalg::transposedProduct(basis, linalg::product(*matrices[i], c));
  }
  problem.toLeftOut = {to};
  problem.fromLeftOut = {from};
  return problem;
}

// The bound lies above the norm of the exact product of the blocks on the whole boundary. It
// exceeds it by the sum of the norms of two parts instead of the norm of their sum, at most twice,
// and by the parameter t of the friction. This holds for all of V, and for the part of V with the
// modes, the responses and one other vector: N_C is then bounded without this vector, so that the
// bound is less sharp. It also is if M K0⁻¹ M on the responses is bounded by μ M, except for
// vectors without a part in the responses. In the last ten draws, no normal forces are due to
// inertia, as under a soft layer, or none to stiffness.
TEST(PointBounds, HoldForTheExactBlocks) {
  std::mt19937 generator(3);
  const PetscInt modes = 14;
  for (int draw = 0; draw < 30; ++draw) {
    const bool isSolved = draw < 10 || draw >= 20;
    auto brake = randomBrake(60, 3, generator);
    if (draw >= 20) (draw % 2 == 0 ? brake.inertia : brake.normal) = DenseMatrix(3, brake.size());
    const double top = 0.6 * brake.omega[modes], theta = std::pow(brake.omega[modes], 2);
    const auto basis = basisOf(brake, modes, -1, generator);
    const auto set =
        completeness::setBounds(matricesOf(brake, basis, modes, theta, isSolved), 1.2 * top);
    DenseMatrix one(basis.columns(), 1);
    one(modes, 0) = one(3, 0) = 1;
    const DenseMatrix all = allOf(basis), some = set.span.vectorsWith(one);
    ASSERT_EQ(some.columns(), basis.columns() - 1);
    for (const auto& [friction, w] :
         {std::pair{0.1, &all}, {1.0, &all}, {0.1, &some}, {1.0, &some}}) {
      const auto bounds = boundsOf(brake, basis, set, friction, *w);
      const DenseMatrix part = linalg::product(basis, linalg::product(set.span.turn(), *w));
      const proof::DiagonalForm form(bounds.kept, top),
          exact(exactBlocks(brake, part, friction), top);
      for (int i = 0; i <= 12; ++i) {
        const Complex z = std::polar(1.05, M_PI * (0.97 - i / 12.0));
        const double bound = proof::Expansion(form, z, 0).boundAtCentre(),
                     truth = proof::Expansion(exact, z, 0).boundAtCentre();
        EXPECT_GE(bound, 0.979 * truth);  // normBound() is up to 2.1 % above the norm
        // The bound μ M instead of M K0⁻¹ M costs half as much again.
        EXPECT_LE(bound, (isSolved ? 4 : 6) * truth + 1e-9);
      }
    }
  }
}

// The counts that are proved are those of all unknowns; of the stronger frictions too most are.
TEST(PointBounds, ProveOnlyTrueCounts) {
  std::mt19937 generator(4);
  const PetscInt modes = 14;
  int proved = 0;
  for (int draw = 0; draw < 40; ++draw) {
    const auto brake = randomBrake(60, 3, generator);
    const double wanted = 0.6 * brake.omega[modes], theta = std::pow(brake.omega[modes], 2);
    const auto basis = basisOf(brake, modes, -1, generator);
    const auto set =
        completeness::setBounds(matricesOf(brake, basis, modes, theta, draw % 4 < 2), 1.2 * wanted);
    const double friction = 0.05 * (1 + draw);
    const auto bounds =
        boundsOf(brake, basis, set, friction, draw % 2 == 0 ? allOf(basis) : set.span.vectors());
    const proof::DiagonalForm form(bounds.kept, wanted);
    const proof::Region region{proof::placedTop(form.eigenvalues(), wanted)};
    const auto count = proof::proveCount(form, bounds.leftOut, region);
    if (count.verdict != proof::Verdict::proved) continue;
    ++proved;
    // The list has Im s ≥ 0, and on the real axis both s and −s.
    PetscInt exact = 0;
    for (const auto& pair : linalg::solveQuadratic(fullProblem(brake, friction)))
      if (std::abs(pair.s) < region.top) exact += pair.s.imag() > 0 ? 2 : 1;
    EXPECT_EQ(count.count, exact);
  }
  EXPECT_GE(proved, 20);
}

// Without one mode below θ, nothing is proved: M on C exceeds 1/θ, and the couplings show it or the
// Sturm count does, which puts θ at this mode.
TEST(PointBounds, AMissingModeProvesNothing) {
  std::mt19937 generator(5);
  const PetscInt modes = 14, without = 6;
  const auto brake = randomBrake(60, 3, generator);
  const double top = 0.6 * brake.omega[modes], theta = std::pow(brake.omega[without], 2);
  ASSERT_GT(top, brake.omega[without]);
  const auto basis = basisOf(brake, modes, without, generator);
  const auto set = completeness::setBounds(matricesOf(brake, basis, modes - 1, theta), 1.2 * top);
  const auto bounds = boundsOf(brake, basis, set, 0.1, allOf(basis));
  const proof::DiagonalForm form(bounds.kept, top);
  EXPECT_EQ(proof::proveCount(form, bounds.leftOut, {top}).verdict, proof::Verdict::indefinite);
}

// A matrix of squares with a negative eigenvalue is a contradiction.
TEST(PointBounds, RefusesContradictions) {
  std::mt19937 generator(6);
  const auto brake = randomBrake(40, 2, generator);
  const auto basis = basisOf(brake, 10, -1, generator);
  const auto set = matricesOf(brake, basis, 10, std::pow(brake.omega[10], 2));
  auto wrong = set;
  wrong.massProduct(11, 11) = 0;
  EXPECT_THROW(boundsOf(brake, basis, completeness::setBounds(wrong, 1), 0.1, allOf(basis)), Error);
  wrong = set;
  for (double& entry : wrong.normalFlexibility.entries()) entry = 0;
  EXPECT_THROW(completeness::setBounds(wrong, 1), Error);
}

}  // namespace
