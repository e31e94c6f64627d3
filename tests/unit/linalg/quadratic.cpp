// Dense quadratic problems whose spectrum is known: proportional damping with multiple eigenvalues,
// overdamped modes, gyroscopic forces; sums and products of all eigenvalues where it is not.
#include "linalg/quadratic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <random>

#include "support/spectrum.hpp"

namespace squeal {
namespace {

using linalg::DenseMatrix;
using linalg::DensePair;
using test::Complex;

double uniform(std::mt19937& generator) {
  return 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1;
}

linalg::DenseMatrix randomMatrix(int m, double diagonal, std::mt19937& generator) {
  linalg::DenseMatrix matrix;
  for (int i = 0; i < m * m; ++i)
    matrix.push_back((i % (m + 1) == 0 ? diagonal : 0) + uniform(generator));
  return matrix;
}

linalg::DenseMatrix product(const linalg::DenseMatrix& a, const linalg::DenseMatrix& b, int m) {
  const auto n = static_cast<std::size_t>(m);
  linalg::DenseMatrix c(n * n, 0.0);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < n; ++i) c[j * n + i] += a[k * n + i] * b[j * n + k];
  return c;
}

double trace(const linalg::DenseMatrix& a, int m) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); i += static_cast<std::size_t>(m) + 1) sum += a[i];
  return sum;
}

/// Q diag(d) Qᵀ, full, with the reflection Q = I − 2 v vᵀ / vᵀv.
linalg::DenseMatrix reflected(const std::vector<double>& d, std::mt19937 generator) {
  const std::size_t m = d.size();
  std::vector<double> v(m);
  double square = 0;
  for (auto& x : v) {
    x = uniform(generator);
    square += x * x;
  }
  const auto q = [&](std::size_t i, std::size_t j) {
    return (i == j ? 1 : 0) - 2 * v[i] * v[j] / square;
  };
  linalg::DenseMatrix matrix(m * m, 0.0);
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t k = 0; k < m; ++k) matrix[j * m + i] += q(i, k) * d[k] * q(j, k);
  return matrix;
}

/// ‖(s² M + s Z + K) q‖ over the sizes of its terms; q of length 1.
double residual(const linalg::DenseMatrix& mass, const linalg::DenseMatrix& damping,
                const linalg::DenseMatrix& stiffness, const linalg::DensePair& pair) {
  const std::size_t m = pair.q.size();
  double rest = 0, scale = 0;
  for (std::size_t i = 0; i < m; ++i) {
    Complex row = 0;
    for (std::size_t j = 0; j < m; ++j) {
      const std::size_t at = j * m + i;
      row += (pair.s * pair.s * mass[at] + pair.s * damping[at] + stiffness[at]) * pair.q[j];
      scale += std::norm(pair.s * pair.s * mass[at]) + std::norm(pair.s * damping[at]) +
               std::norm(stiffness[at]);
    }
    rest += std::norm(row);
  }
  return std::sqrt(rest / scale);
}

double worstResidual(const linalg::DenseMatrix& mass, const linalg::DenseMatrix& damping,
                     const linalg::DenseMatrix& stiffness,
                     const std::vector<linalg::DensePair>& pairs) {
  double worst = 0;
  for (const auto& pair : pairs) worst = std::max(worst, residual(mass, damping, stiffness, pair));
  return worst;
}

std::vector<Complex> eigenvalues(const std::vector<linalg::DensePair>& pairs) {
  std::vector<Complex> list;
  for (const auto& pair : pairs) list.push_back(pair.s);
  return list;
}

void expectSpectrum(const std::vector<linalg::DensePair>& found, const std::vector<Complex>& wanted,
                    double tolerance) {
  EXPECT_EQ(found.size(), wanted.size());
  EXPECT_LT(test::worst(test::errors(wanted, eigenvalues(found)).relative), tolerance);
}

/// Volume that unit vectors span: 1 if orthogonal, 0 if dependent.
double volume(std::vector<std::vector<Complex>> vectors) {
  double product = 1;
  for (std::size_t j = 0; j < vectors.size(); ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      Complex dot = 0;
      for (std::size_t i = 0; i < vectors[j].size(); ++i)
        dot += std::conj(vectors[k][i]) * vectors[j][i];
      for (std::size_t i = 0; i < vectors[j].size(); ++i) vectors[j][i] -= dot * vectors[k][i];
    }
    double square = 0;
    for (const auto& entry : vectors[j]) square += std::norm(entry);
    for (auto& entry : vectors[j]) entry /= std::sqrt(square);
    product *= std::sqrt(square);
  }
  return product;
}

// Z = α M + β K: s² + (α + β ω²) s + ω² = 0 for every mode of M and K, here with a triple one, the
// lowest and the highest overdamped.
TEST(Dense, ProportionalDampingOfMultipleModes) {
  constexpr int m = 90;
  constexpr double alpha = 25e3, beta = 5e-6;
  std::vector<double> square, c;
  std::vector<Complex> exact;
  const auto frequency = [](int level) { return 1e4 * std::pow(60.0, level / (m - 1.0)); };
  for (int i = 0; i < m; ++i) {
    const double w = frequency(i == 31 || i == 32 ? 30 : i);
    square.push_back(w * w);
    c.push_back(alpha + beta * w * w);
    const Complex root = std::sqrt(Complex(c.back() * c.back() / 4 - w * w));
    exact.push_back(-c.back() / 2 + root);
    if (root.imag() == 0) exact.push_back(-c.back() / 2 - root);
  }
  EXPECT_GT(exact.size(), m + 5u);   // at both ends some are overdamped
  EXPECT_LT(exact.size(), m + 50u);  // and in the middle some are not
  std::mt19937 generator;
  const auto mass = reflected(std::vector<double>(m, 1.0), generator),
             damping = reflected(c, generator), stiffness = reflected(square, generator);
  const auto pairs = linalg::solveQuadratic(mass, damping, stiffness, m);
  // Entries are rounded at 1e-16 ‖K‖, 4e-13 of the lowest ω²; near critical damping the roots move
  // some ten times as much.
  expectSpectrum(pairs, exact, 1e-10);
  EXPECT_LT(worstResidual(mass, damping, stiffness, pairs), 1e-14);
  const double w = frequency(30), half = (alpha + beta * w * w) / 2;
  std::vector<std::vector<Complex>> triple;
  for (const auto& pair : pairs)
    if (std::abs(pair.s - Complex(-half, std::sqrt(w * w - half * half))) < 1e-8 * w)
      triple.push_back(pair.q);
  EXPECT_EQ(triple.size(), 3u);
  EXPECT_GT(volume(triple), 1e-3);  // three different modes, not one thrice
}

/// Sums of the first three powers of all 2m eigenvalues, for M = I:
///   Σ s = −tr Z,  Σ s² = tr Z² − 2 tr K,  Σ s³ = −tr Z³ + 3 tr Z K.
/// One eigenvalue missed, or found twice, shows in all of them.
struct PowerSums {
  double sum[3] = {0, 0, 0};
  double size[3] = {0, 0, 0};  ///< the same of |s|
};

PowerSums exactSums(const linalg::DenseMatrix& damping, const linalg::DenseMatrix& stiffness,
                    int m) {
  const auto square = product(damping, damping, m), cube = product(square, damping, m),
             mixed = product(damping, stiffness, m);
  return {{-trace(damping, m), trace(square, m) - 2 * trace(stiffness, m),
           -trace(cube, m) + 3 * trace(mixed, m)},
          {}};
}

PowerSums foundSums(const std::vector<linalg::DensePair>& pairs) {
  PowerSums found;
  for (const auto& pair : pairs)
    for (int power = 1; power <= 3; ++power) {
      const int times = pair.s.imag() == 0 ? 1 : 2;  // s and its conjugate
      found.sum[power - 1] += times * std::pow(pair.s, power).real();
      found.size[power - 1] += times * std::pow(std::abs(pair.s), power);
    }
  return found;
}

void expectPowerSums(const std::vector<linalg::DensePair>& pairs,
                     const linalg::DenseMatrix& damping, const linalg::DenseMatrix& stiffness,
                     int m, double tolerance) {
  const PowerSums exact = exactSums(damping, stiffness, m), found = foundSums(pairs);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(found.sum[k], exact.sum[k], tolerance * found.size[k]) << "power " << k + 1;
}

// Damped, gyroscopic and circulatory forces at once. P and D P have the same eigenvalues; D with
// entries from 1 to 1e6 makes the mass ill-conditioned, which takes the way of QZ.
TEST(Dense, NoEigenvalueIsMissed) {
  std::mt19937 generator(5);
  for (const int m : {60, 150}) {
    const auto order = static_cast<std::size_t>(m);
    const linalg::DenseMatrix damping = randomMatrix(m, 0.3, generator),
                              stiffness = randomMatrix(m, 4.0 * m, generator);
    linalg::DenseMatrix mass(order * order, 0.0), scaled[3];
    for (std::size_t i = 0; i < order; ++i) mass[i * order + i] = 1;
    const auto pairs = linalg::solveQuadratic(mass, damping, stiffness, m);
    expectPowerSums(pairs, damping, stiffness, m, 1e-13);
    EXPECT_LT(worstResidual(mass, damping, stiffness, pairs), 1e-13);
    const linalg::DenseMatrix* whole[3] = {&mass, &damping, &stiffness};
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < order * order; ++i)
        scaled[k].push_back(std::pow(1e6, static_cast<double>(i % order) / m) * (*whole[k])[i]);
    // Backward errors of QZ are relative to the largest rows, 1e6 times the smallest.
    expectSpectrum(linalg::solveQuadratic(scaled[0], scaled[1], scaled[2], m), eigenvalues(pairs),
                   1e-8);
  }
}

/// P with each matrix transposed, and the left vectors, conjugate, as its right ones: yᴴ P(s) = 0
/// is P(s)ᵀ ȳ = 0.
double worstLeftResidual(const linalg::DenseMatrix& mass, const linalg::DenseMatrix& damping,
                         const linalg::DenseMatrix& stiffness,
                         const std::vector<linalg::DensePair>& pairs) {
  const std::size_t m = pairs.front().q.size();
  const auto transposed = [m](const linalg::DenseMatrix& a) {
    linalg::DenseMatrix result(m * m, 0.0);
    for (std::size_t k = 0; k < a.size(); ++k) result[(k % m) * m + k / m] = a[k];
    return result;
  };
  std::vector<linalg::DensePair> flipped;
  for (const auto& pair : pairs) {
    flipped.push_back({pair.s, pair.left});
    double square = 0;
    for (auto& entry : flipped.back().q) {
      square += std::norm(entry);
      entry = std::conj(entry);
    }
    EXPECT_NEAR(square, 1, 1e-12);
  }
  return worstResidual(transposed(mass), transposed(damping), transposed(stiffness), flipped);
}

// By QR and by QZ, with damping and without, from rank 0 to all.
TEST(Dense, LeftVectors) {
  constexpr int m = 40;
  std::mt19937 generator(11);
  const linalg::DenseMatrix damping = randomMatrix(m, 0.3, generator),
                            stiffness = randomMatrix(m, 4.0 * m, generator);
  const linalg::DenseMatrix plain = randomMatrix(m, 3.0 * m, generator);
  for (const double spread : {1.0, 1e6}) {
    linalg::DenseMatrix mass = plain;
    for (std::size_t k = 0; k < mass.size(); ++k)
      mass[k] *= std::pow(spread, -static_cast<double>(k % m) / m);
    for (const auto& z : {damping, linalg::DenseMatrix()}) {
      const auto pairs =
          linalg::solveTogether(PETSC_COMM_WORLD, mass, z, stiffness, m, linalg::Vectors::both);
      const auto right = linalg::solveTogether(PETSC_COMM_WORLD, mass, z, stiffness, m);
      const linalg::DenseMatrix known = z.empty() ? linalg::DenseMatrix(mass.size(), 0.0) : z;
      EXPECT_EQ(pairs.size(), right.size());
      EXPECT_TRUE(right.front().left.empty());
      EXPECT_LT(worstResidual(mass, known, stiffness, pairs), 1e-13);
      EXPECT_LT(worstLeftResidual(mass, known, stiffness, pairs), 1e-13);
    }
  }
}

// Without damping forces gyroscopic ones do no work: all eigenvalues stay on the imaginary axis.
TEST(Dense, GyroscopicForcesDoNoWork) {
  constexpr int m = 80;
  std::mt19937 generator(6);
  const linalg::DenseMatrix any = randomMatrix(m, 0, generator);
  linalg::DenseMatrix gyroscopic(any.size()), mass(any.size(), 0.0), stiffness(any.size(), 0.0);
  for (std::size_t j = 0; j < m; ++j) {
    for (std::size_t i = 0; i < m; ++i) gyroscopic[j * m + i] = any[j * m + i] - any[i * m + j];
    mass[j * m + j] = 1;
    stiffness[j * m + j] = 1 + static_cast<double>(j * j);
  }
  const auto pairs = linalg::solveQuadratic(mass, gyroscopic, stiffness, m);
  EXPECT_EQ(pairs.size(), static_cast<std::size_t>(m));
  for (const auto& pair : pairs) EXPECT_LT(std::abs(pair.s.real()), 1e-11);
  EXPECT_LT(worstResidual(mass, gyroscopic, stiffness, pairs), 1e-13);
}

// Damping of the size of rounding, as at the first friction of a sweep, leaves the undamped
// spectrum, double frequencies included. Without friction and damping the eigenvalues of a moving
// disc are imaginary, exactly: whatever rounding makes of a frequency of 1e-5 of the highest, some
// 1e-16 × 1e10 of itself, is no growth.
TEST(Dense, GyroscopicForcesLeaveNoGrowth) {
  constexpr int m = 40;
  std::mt19937 generator(5);
  std::vector<double> squares;
  for (int i = 0; i < m; ++i) squares.push_back(std::pow(10.0, 0.25 * i));  // 1 to 5.6e9
  const linalg::DenseMatrix stiffness = reflected(squares, generator),
                            mass = reflected(std::vector<double>(m, 1.0), generator);
  linalg::DenseMatrix gyroscopic(m * m, 0.0);
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < j; ++i) {
      gyroscopic[j * m + i] = 0.1 * uniform(generator);
      gyroscopic[i * m + j] = -gyroscopic[j * m + i];
    }
  const auto pairs = linalg::solveQuadratic(mass, gyroscopic, stiffness, m);
  ASSERT_EQ(pairs.size(), m);
  for (const auto& pair : pairs) EXPECT_EQ(pair.s.real(), 0) << pair.s;
  // A little damping is not mistaken for none.
  linalg::DenseMatrix damped = gyroscopic;
  for (std::size_t i = 0; i < m; ++i) damped[i * (m + 1)] = 1e-9;
  for (const auto& pair : linalg::solveQuadratic(mass, damped, stiffness, m))
    EXPECT_NE(pair.s.real(), 0) << pair.s;
}

TEST(Dense, DampingThatIsNextToNothing) {
  constexpr int m = 60;
  std::mt19937 generator(8);
  std::vector<double> square;
  std::vector<Complex> exact;
  for (int i = 0; i < m; ++i) {
    exact.emplace_back(0, 1e4 * (1 + i / 2));
    square.push_back(std::norm(exact.back()));
  }
  const auto mass = reflected(std::vector<double>(m, 1.0), generator),
             stiffness = reflected(square, generator);
  linalg::DenseMatrix damping = randomMatrix(m, 0, generator);
  for (auto& entry : damping) entry *= 1e-12;
  expectSpectrum(linalg::solveQuadratic(mass, damping, stiffness, m), exact, 1e-12);
}

// The size of the reduced problem of a brake after its corrections.
TEST(Dense, LargeProblem) {
  constexpr int m = 500;
  std::mt19937 generator(9);
  const linalg::DenseMatrix damping = randomMatrix(m, 0.1, generator),
                            stiffness = randomMatrix(m, 8.0 * m, generator);
  linalg::DenseMatrix mass(static_cast<std::size_t>(m) * m, 0.0);
  for (std::size_t i = 0; i < m; ++i) mass[i * m + i] = 1;
  const auto start = std::clock();
  const auto pairs = linalg::solveQuadratic(mass, damping, stiffness, m);
  test::print("all eigenvalues of a quadratic problem of size %d: %.2f s of processor time\n", m,
              static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  expectPowerSums(pairs, damping, stiffness, m, 1e-13);
}

}  // namespace
}  // namespace squeal
