// SPDX-License-Identifier: BSD-2-Clause
// The blocks of a point with damping, gyroscopic terms and friction of its own, against those
// computed from all unknowns.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/error.hpp"
#include "eigen/completeness/damped_bounds.hpp"
#include "eigen/proof/count.hpp"
#include "eigen/proof/expansion.hpp"
#include "support/algebra/dense.hpp"

namespace {

using namespace squeal;
using completeness::DampedPoint;
using completeness::DampedSet;
using linalg::DenseMatrix;

constexpr PetscInt size = 60, modes = 14, nodes = 3, jumpRows = 2 * nodes;
/// The matrices of the set are those of the brake divided by these factors.
constexpr std::array bodyFactors{0.5, -3.0, 2.0}, normalFactors{1.0, 1.0, -4.0};

DenseMatrix scaled(DenseMatrix matrix, double factor) {
  for (double& entry : matrix.entries()) entry *= factor;
  return matrix;
}

/// A brake in coordinates in which K0 = 1 and M0 = diag(1/ω²).
struct Brake {
  std::vector<double> omega;              // ascending
  DenseMatrix jumps, convected;           // J and D
  std::array<DenseMatrix, 3> normal;      // [power] N_X of the stiffness, the damping, the mass
  DenseMatrix damping, gyroscopic, spin;  // C ≥ 0, G, K^R
  pencil::PointFactors friction;          // Φ and B
  double top = 0;                         // of the regions
};

/// Rotating at `speed`, with friction damping proportional to 1/speed.
Brake randomBrake(double friction, double speed, std::mt19937& generator) {
  Brake brake;
  std::exponential_distribution<double> gap(1);
  double frequency = 1;
  for (PetscInt j = 0; j < size; ++j) brake.omega.push_back(frequency += 0.1 + gap(generator));
  brake.top = 0.6 * brake.omega[modes];
  const auto rows = [&](PetscInt count, double scale) {
    DenseMatrix result = test::randomMatrix(count, size, generator);
    for (PetscInt j = 0; j < size; ++j)
      for (double& entry : result.column(j)) entry *= scale / brake.omega[j];
    return result;
  };
  const auto square = [&](double scale, bool skew) {  // in energy, as X/ωω
    const DenseMatrix one = test::randomMatrix(size, size, generator);
    DenseMatrix result(size, size);
    for (PetscInt j = 0; j < size; ++j)
      for (PetscInt i = 0; i < size; ++i)
        result(i, j) =
            scale * (one(i, j) + (skew ? -1 : 1) * one(j, i)) / (brake.omega[i] * brake.omega[j]);
    return result;
  };
  const double square2 = std::pow(brake.omega[size / 2], 2);
  brake.jumps = rows(jumpRows, 1.5);
  brake.convected = rows(jumpRows, 1);
  brake.normal = {rows(nodes, 2), rows(nodes, 0.02), rows(nodes, 2 / square2)};
  const DenseMatrix root = test::randomMatrix(size, 5, generator);
  brake.damping = linalg::product(root, linalg::transposed(root));
  for (PetscInt j = 0; j < size; ++j)
    for (PetscInt i = 0; i < size; ++i)
      brake.damping(i, j) *= 0.02 / (brake.omega[i] * brake.omega[j]);
  brake.gyroscopic = square(0.02 * speed, true);
  brake.spin = square(0.01 * speed * speed, false);
  brake.friction.slip = DenseMatrix(nodes, jumpRows);
  brake.friction.response = DenseMatrix(jumpRows, jumpRows);
  for (PetscInt i = 0; i < nodes; ++i) {  // along the first direction, damping across it
    brake.friction.slip(i, 2 * i) = friction;
    brake.friction.response(2 * i + 1, 2 * i + 1) = friction * 0.2 / speed;
  }
  return brake;
}

DenseMatrix massOf(const Brake& brake) {
  DenseMatrix mass(size, size);
  for (PetscInt j = 0; j < size; ++j) mass(j, j) = std::pow(brake.omega[j], -2);
  return mass;
}

/// Returns P of all unknowns.
linalg::DenseProblem fullProblem(const Brake& brake, double speed) {
  linalg::DenseProblem problem;
  const DenseMatrix slip = linalg::product(brake.friction.slip, brake.jumps),
                    left = linalg::transposedProduct(brake.jumps, brake.friction.response);
  problem.stiffness = test::identity(size);
  problem.mass = massOf(brake);
  problem.damping = brake.damping;
  linalg::addScaled(problem.damping, 1, brake.gyroscopic);
  linalg::addScaled(problem.damping, 1, linalg::product(left, brake.jumps));
  linalg::addScaled(problem.stiffness, 1, brake.spin);
  linalg::addScaled(problem.stiffness, -speed, linalg::product(left, brake.convected));
  for (int power = 0; power < 3; ++power)
    linalg::addScaled(problem.ofPower(power), 1,
                      linalg::transposedProduct(slip, brake.normal[power]));
  return problem;
}

DenseMatrix timesTransposed(const DenseMatrix& a, const DenseMatrix& b) {
  return linalg::product(a, linalg::transposed(b));
}

/// V, which is orthonormal only within 10⁻³: the lowest modes, responses to J, and two vectors.
DenseMatrix basisOf(const Brake& brake, std::mt19937& generator) {
  DenseMatrix others = linalg::transposed(brake.jumps), basis(size, modes);
  others.append(test::randomMatrix(size, 2, generator));
  for (PetscInt i = 0; i < modes; ++i) basis(i, i) = 1;
  for (PetscInt j = 0; j < others.columns(); ++j) {
    for (PetscInt i = 0; i < modes; ++i) others(i, j) *= 1e-3;
    const double length = std::sqrt(linalg::squaredLength(others.column(j)));
    for (double& entry : others.column(j)) entry /= length;
  }
  basis.append(others);
  return basis;
}

double norm(const DenseMatrix& a) {
  return std::sqrt(linalg::symmetricEigenvalues(linalg::transposedProduct(a, a)).back());
}

/// Returns an orthonormal basis of the complement of V.
DenseMatrix complementOf(const DenseMatrix& basis) {
  const DenseMatrix v = linalg::product(
      basis,
      linalg::inverseTransposed(linalg::choleskyFactor(linalg::transposedProduct(basis, basis))));
  DenseMatrix projector = timesTransposed(v, v);
  linalg::symmetricEigen(projector);  // the eigenvalue 0 comes first
  return DenseMatrix(projector.columnRange(0, size - v.columns()));
}

/// Returns the matrices of the set, computed as from static responses, with exact norms on C.
DampedSet setOf(const Brake& brake, const DenseMatrix& basis) {
  DampedSet set;
  const DenseMatrix mass = massOf(brake), c = complementOf(basis);
  set.modes = {0, modes, std::pow(brake.omega[modes], 2), 0};
  set.energy = linalg::transposedProduct(basis, basis);
  set.mass = linalg::congruent(mass, basis);
  const std::array matrices{mass, scaled(brake.damping, 1 / bodyFactors[0]),
                            scaled(brake.gyroscopic, 1 / bodyFactors[1]),
                            scaled(brake.spin, 1 / bodyFactors[2])};
  const std::array powers{2, 1, 1, 0};
  std::vector<DenseMatrix> products;
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    products.push_back(linalg::product(matrices[i], basis));
    auto& row = set.products.emplace_back();
    for (std::size_t j = 0; j <= i; ++j)
      row.push_back(j < i && powers[i] == 0 ? DenseMatrix()
                                            : linalg::transposedProduct(products[i], products[j]));
    if (i > 0)
      set.bodies.push_back({powers[i], i == 2, linalg::congruent(matrices[i], basis),
                            norm(linalg::congruent(matrices[i], c)), 0});
  }
  std::size_t next = 0;
  for (const int power : {0, 2, 1}) {
    const DenseMatrix rows = scaled(brake.normal[power], 1 / normalFactors[next++]);
    set.normals.push_back({power, linalg::product(rows, basis), timesTransposed(rows, rows),
                           power == 1 ? DenseMatrix() : linalg::product(rows, products[0])});
  }
  set.normalProduct = timesTransposed(brake.normal[0], brake.normal[2]);
  set.jumps = linalg::product(brake.jumps, basis);
  set.jumpsOnC = norm(linalg::product(brake.jumps, c));
  set.convected = linalg::product(brake.convected, basis);
  set.convectedFlexibility = timesTransposed(brake.convected, brake.convected);
  return set;
}

/// Returns the data of the point, with all of V in the subspace.
DampedPoint pointOf(const Brake& brake, const DenseMatrix& basis, double speed) {
  const auto full = fullProblem(brake, speed);
  return {.problem = {.mass = linalg::congruent(full.mass, basis),
                      .damping = linalg::congruent(full.damping, basis),
                      .stiffness = linalg::congruent(full.stiffness, basis)},
          .bodyFactors = {bodyFactors.begin(), bodyFactors.end()},
          .normalFactors = {normalFactors.begin(), normalFactors.end()},
          .speed = speed,
          .friction = brake.friction,
          .vectors = test::identity(basis.columns()),
          .forces = {}};
}

completeness::PointBounds boundsOf(const Brake& brake, const DenseMatrix& basis, double speed) {
  return completeness::dampedBounds(setOf(brake, basis), pointOf(brake, basis, speed), brake.top);
}

/// Returns the exact blocks on V and on an orthonormal complement C.
proof::KeptProblem exactBlocks(const linalg::DenseProblem& full, const DenseMatrix& basis) {
  const DenseMatrix v = linalg::product(
      basis,
      linalg::inverseTransposed(linalg::choleskyFactor(linalg::transposedProduct(basis, basis))));
  const DenseMatrix c = complementOf(basis);
  proof::KeptProblem problem;
  proof::Coupling to, from;
  const std::array matrices{&full.stiffness, &full.damping, &full.mass};
  for (int power = 0; power < 3; ++power) {
    const auto& matrix = *matrices[power];
    problem.matrices[power] = linalg::congruent(matrix, v);
    to.coefficients[power] = linalg::transposedProduct(c, linalg::product(matrix, v));
    from.coefficients[power] = linalg::transposedProduct(v, linalg::product(matrix, c));
  }
  problem.toLeftOut = {to};
  problem.fromLeftOut = {from};
  return problem;
}

// The bound lies above the norm of the exact product of the blocks on the whole boundary. The main
// terms are exact; the gyroscopic, convective and spin terms, which are small, are bounded by the
// sum of their norms, multiplied by up to √(1 + 1/0.02) = 7. The bounds hold up to |z| = 1.3.
TEST(DampedBounds, HoldForTheExactBlocks) {
  std::mt19937 generator(7);
  for (int draw = 0; draw < 10; ++draw) {
    const double friction = 0.1 + 0.1 * draw, speed = draw % 2 == 0 ? 0.02 : 1;
    const auto brake = randomBrake(friction, speed, generator);
    const auto basis = basisOf(brake, generator);
    const auto bounds = boundsOf(brake, basis, speed);
    const proof::DiagonalForm form(bounds.kept, brake.top),
        exact(exactBlocks(fullProblem(brake, speed), basis), brake.top);
    ASSERT_EQ(form.size(), exact.size());
    for (int i = 0; i < 26; ++i) {
      const Complex z = std::polar(i % 2 == 0 ? 1.05 : 1.29, M_PI * (0.97 - i / 26.0));
      const double bound = proof::Expansion(form, z, 0).boundAtCentre(),
                   truth = proof::Expansion(exact, z, 0).boundAtCentre();
      EXPECT_GE(bound, 0.979 * truth);  // normBound() is up to 2.1 % above the norm
      if (i % 2 == 0) {
        EXPECT_LE(bound, 1.5 * truth);
      }
    }
    EXPECT_TRUE(std::isinf(proof::Expansion(form, {0, 1.31}, 0).boundAtCentre()));
  }
}

// Responses to the jumps that V lacks enter by the norm of J on C, with the friction damping that
// they leave in all blocks. Here V has them within 1 % of their length.
TEST(DampedBounds, CountWhatResponsesLackInErrors) {
  std::mt19937 generator(12);
  for (int draw = 0; draw < 10; ++draw) {
    const double speed = draw % 2 == 0 ? 0.05 : 1;
    const auto brake = randomBrake(0.3, speed, generator);
    auto basis = basisOf(brake, generator);
    const DenseMatrix noise = test::randomMatrix(size, jumpRows, generator);
    for (PetscInt j = 0; j < jumpRows; ++j)
      for (PetscInt i = modes; i < size; ++i) basis(i, modes + j) += 1e-3 * noise(i, j);
    const auto bounds = boundsOf(brake, basis, speed);
    const proof::DiagonalForm form(bounds.kept, brake.top),
        exact(exactBlocks(fullProblem(brake, speed), basis), brake.top);
    for (int i = 0; i < 13; ++i) {
      const Complex z = std::polar(1.05, M_PI * (0.97 - i / 13.0));
      EXPECT_GE(proof::Expansion(form, z, 0).boundAtCentre(),
                0.979 * proof::Expansion(exact, z, 0).boundAtCentre());
    }
  }
}

// The vectors that a point uses span a part of V: the modes, the responses and its own vectors.
TEST(DampedBounds, UseAPartOfTheBasis) {
  std::mt19937 generator(13);
  const auto brake = randomBrake(0.5, 1, generator);
  const auto basis = basisOf(brake, generator);
  const auto set = setOf(brake, basis);
  auto point = pointOf(brake, basis, 1);
  point.vectors = DenseMatrix(basis.columns());
  const auto without = completeness::dampedBounds(set, point, brake.top);
  EXPECT_EQ(without.kept.order(), modes + jumpRows);
  DenseMatrix one(basis.columns(), 1);
  one(basis.columns() - 1, 0) = 2;
  point.vectors = one;
  EXPECT_EQ(completeness::dampedBounds(set, point, brake.top).kept.order(), modes + jumpRows + 1);
  point.vectors = DenseMatrix(basis.columns());
  point.forces = linalg::product(set.energy, one);  // the response to V^T K0 x is x
  EXPECT_EQ(completeness::dampedBounds(set, point, brake.top).kept.order(), modes + jumpRows + 1);
  // The block on the part has the matrices of its vectors.
  DenseMatrix part(basis.columnRange(0, modes + jumpRows));
  const proof::DiagonalForm form(without.kept, brake.top),
      exact(exactBlocks(fullProblem(brake, 1), part), brake.top);
  for (int i = 0; i < 13; ++i) {
    const Complex z = std::polar(1.05, M_PI * (0.97 - i / 13.0));
    const double bound = proof::Expansion(form, z, 0).boundAtCentre(),
                 truth = proof::Expansion(exact, z, 0).boundAtCentre();
    EXPECT_GE(bound, 0.979 * truth);
    EXPECT_LE(bound, 1.5 * truth);
  }
}

// On C, the real part of P is at least δ: the smallest eigenvalue of its symmetric part.
TEST(DampedBounds, BoundTheBlockThatIsLeftOut) {
  std::mt19937 generator(8);
  for (int draw = 0; draw < 10; ++draw) {
    const double speed = draw % 2 == 0 ? 0.02 : 1;
    const auto brake = randomBrake(1, speed, generator);
    const auto basis = basisOf(brake, generator);
    const auto leftOut = boundsOf(brake, basis, speed).leftOut;
    const auto full = fullProblem(brake, speed);
    const DenseMatrix c = complementOf(basis);
    const double left = 0.1 * brake.top;
    for (const Complex s : {Complex(0, brake.top), Complex(-left, 0.9 * brake.top),
                            Complex(-left, 0), Complex(0.7 * brake.top, 0.7 * brake.top)}) {
      // Re xᴴ P x for complex x: the Hermitian part, as a real matrix of twice the size
      const Complex square = s * s;
      const PetscInt n = c.columns();
      DenseMatrix real(n, n), imaginary(n, n), whole(2 * n, 2 * n);
      const auto add = [&](const DenseMatrix& matrix, Complex factor) {
        const DenseMatrix part = linalg::congruent(matrix, c);
        linalg::addScaled(real, factor.real(), part);
        linalg::addScaled(imaginary, factor.imag(), part);
      };
      add(full.stiffness, 1);
      add(full.damping, s);
      add(full.mass, square);
      for (PetscInt j = 0; j < n; ++j)
        for (PetscInt i = 0; i < n; ++i) {
          whole(i, j) = whole(n + i, n + j) = (real(i, j) + real(j, i)) / 2;
          whole(n + i, j) = (imaginary(i, j) - imaginary(j, i)) / 2;
          whole(j, n + i) = whole(n + i, j);
        }
      EXPECT_GE(linalg::symmetricEigenvalues(whole).front(),
                proof::definiteness(leftOut, std::abs(s), left) - 1e-12);
    }
  }
}

// The counts that are proved are those of all unknowns, at low speed too, where friction damping is
// strong; most are proved.
TEST(DampedBounds, ProveOnlyTrueCounts) {
  std::mt19937 generator(9);
  int proved = 0;
  for (int draw = 0; draw < 40; ++draw) {
    const double friction = 0.025 * (1 + draw), speed = draw % 2 == 0 ? 0.02 : 1;
    const auto brake = randomBrake(friction, speed, generator);
    const auto basis = basisOf(brake, generator);
    const auto bounds = boundsOf(brake, basis, speed);
    const proof::DiagonalForm form(bounds.kept, brake.top);
    const double top = proof::placedTop(form.eigenvalues(), brake.top, 0.04);
    const auto [region, count] = proof::proveDamped(form, bounds.leftOut, top, 0.05, {}, 400);
    if (count.verdict != proof::Verdict::proved) continue;
    ++proved;
    PetscInt exact = 0;
    for (const auto& pair : linalg::solveQuadratic(fullProblem(brake, speed)))
      if (std::abs(pair.s) < region.top && pair.s.real() > -region.left)
        exact += pair.s.imag() > 0 ? 2 : 1;
    EXPECT_EQ(count.count, exact);
  }
  EXPECT_GE(proved, 20);
}

// A basis without responses to the jumps proves nothing: the bound of J on C enters with friction.
TEST(DampedBounds, WithoutResponsesNothingIsProved) {
  std::mt19937 generator(10);
  const double speed = 0.02;
  const auto brake = randomBrake(1, speed, generator);
  DenseMatrix basis(size, modes);
  for (PetscInt i = 0; i < modes; ++i) basis(i, i) = 1;
  basis.append(test::randomMatrix(size, 2, generator));
  const auto bounds = boundsOf(brake, basis, speed);
  const proof::DiagonalForm form(bounds.kept, brake.top);
  const auto [region, count] = proof::proveDamped(form, bounds.leftOut, brake.top, 0.05, {}, 400);
  EXPECT_EQ(count.verdict, proof::Verdict::indefinite);
}

// Factors that are not those of the problem are found.
TEST(DampedBounds, RefuseFactorsOfAnotherProblem) {
  std::mt19937 generator(11);
  const auto brake = randomBrake(0.5, 1, generator);
  const auto basis = basisOf(brake, generator);
  const auto set = setOf(brake, basis);
  auto point = pointOf(brake, basis, 1);
  point.friction.response(1, 1) *= 1.001;
  EXPECT_THROW(completeness::dampedBounds(set, point, brake.top), Error);
  point = pointOf(brake, basis, 1);
  point.bodyFactors[1] = 0.999;
  EXPECT_THROW(completeness::dampedBounds(set, point, brake.top), Error);
  EXPECT_NO_THROW(completeness::dampedBounds(set, pointOf(brake, basis, 1), brake.top));
}

}  // namespace
