// Flutter problems with answers in closed form: two coupled oscillators, damping, rotation,
// divergence; norms and backward errors.
#include "reduction/reduced.hpp"

#include <gtest/gtest.h>
#include <petscblaslapack.h>
#include <petscsys.h>  // before the next header, which needs it

#include <cmath>
#include <random>

#include "direct/direct.hpp"
#include "flutter/terms.hpp"
#include "linalg/complexvector.hpp"
#include "linalg/quadratic.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "support/layers.hpp"
#include "support/spectrum.hpp"
#include "sweep/sweep.hpp"

namespace squeal {
namespace {

using linalg::DenseMatrix;
using linalg::DensePair;
using test::Complex;
using test::Layers;

// Mode coupling (Hoffmann, Fischer, Allgaier and Gaul 2002, in normal form): M = I, K = [k1, f k3;
// −f k3, k2].
//   μ = −s²:  (k1 − μ)(k2 − μ) + f² k3² = 0,  μ = (k1 + k2)/2 ± √((k1 − k2)²/4 − f² k3²)
// The frequencies merge at f = |k1 − k2| / (2 k3); beyond, μ = a ± ib and s = √(−μ):
//   growth √((|μ| − a)/2), frequency √((|μ| + a)/2).
struct Oscillators {
  double k1, k2, k3;
  double critical() const { return std::abs(k1 - k2) / (2 * k3); }
  linalg::DenseMatrix stiffness(double f) const {
    return {k1, -f * k3, f * k3, k2};
  }  // column-major
  /// With Im s ≥ 0, by ascending frequency, then growth.
  std::vector<Complex> exact(double f) const {
    const double a = (k1 + k2) / 2, square = (k1 - k2) * (k1 - k2) / 4 - f * f * k3 * k3;
    if (square >= 0)
      return {{0, std::sqrt(a - std::sqrt(square))}, {0, std::sqrt(a + std::sqrt(square))}};
    const double size = std::hypot(a, std::sqrt(-square)), growth = std::sqrt((size - a) / 2),
                 frequency = std::sqrt((size + a) / 2);
    return {{-growth, frequency}, {growth, frequency}};
  }
};
const Oscillators coupledPair{1.0, 1.5, 0.8};

const linalg::DenseMatrix identity2{1, 0, 0, 1};

std::vector<Complex> eigenvalues(const std::vector<linalg::DensePair>& pairs) {
  std::vector<Complex> list;
  for (const auto& pair : pairs) list.push_back(pair.s);
  return list;
}

/// Each wanted value is found within `tolerance` of its size, and none is found beside them.
void expectSpectrum(const std::vector<Complex>& found, const std::vector<Complex>& wanted,
                    double tolerance) {
  EXPECT_EQ(found.size(), wanted.size());
  EXPECT_LT(test::worst(test::errors(wanted, found).relative), tolerance);
}

/// ‖(s² M + s Z + K) q‖ over the sizes of its terms; q of length 1.
double residual(const linalg::DenseMatrix& mass, const linalg::DenseMatrix& damping,
                const linalg::DenseMatrix& stiffness, const linalg::DensePair& pair) {
  const std::size_t m = pair.q.size();
  double rest = 0, scale = 0, length = 0;
  for (std::size_t i = 0; i < m; ++i) {
    Complex row = 0;
    for (std::size_t j = 0; j < m; ++j) {
      const Complex entry = pair.s * pair.s * mass[j * m + i] +
                            (damping.empty() ? 0 : pair.s * damping[j * m + i]) +
                            stiffness[j * m + i];
      row += entry * pair.q[j];
      scale += std::norm(pair.s * pair.s * mass[j * m + i]) + std::norm(stiffness[j * m + i]);
    }
    rest += std::norm(row);
    length += std::norm(pair.q[i]);
  }
  EXPECT_NEAR(length, 1, 1e-12);
  return std::sqrt(rest / scale);
}

TEST(Dense, ModesCoupleAtTheCriticalFriction) {
  const double critical = coupledPair.critical();
  EXPECT_NEAR(critical, 0.3125, 1e-15);
  for (const double f : {0.0, 0.1, 0.3, 0.9999 * critical, 1.0001 * critical, 0.4, 1.0, 3.0})
    for (const bool companion : {false, true}) {
      const linalg::DenseMatrix damping =
          companion ? linalg::DenseMatrix(4, 0.0) : linalg::DenseMatrix();
      const auto pairs = linalg::solveQuadratic(identity2, damping, coupledPair.stiffness(f), 2);
      // Near the critical point the eigenvalue is a square root of the distance: rounding of 1e-16
      // grows by 1e2 at 1e-4 from it.
      expectSpectrum(eigenvalues(pairs), coupledPair.exact(f), 1e-13);
      for (const auto& pair : pairs)
        EXPECT_LT(residual(identity2, damping, coupledPair.stiffness(f), pair), 1e-14);
    }
  // At the critical point itself two eigenvalues and their vectors are one: half of the digits
  // remain.
  expectSpectrum(
      eigenvalues(linalg::solveQuadratic(identity2, {}, coupledPair.stiffness(critical), 2)),
      coupledPair.exact(critical), 1e-7);
}

// m s² + c s + k = 0: under-damped, over-damped (both roots are real and count), with negative
// damping.
TEST(Dense, DampedOscillator) {
  const double m = 2, k = 50;
  for (const double c : {0.4, -0.4, 15.0}) {
    const Complex root = std::sqrt(Complex(c * c - 4 * m * k)) / (2 * m);
    expectSpectrum(eigenvalues(linalg::solveQuadratic({m}, {c}, {k}, 1)), {-c / (2 * m) + root},
                   1e-14);
  }
  const double c = 30, root = std::sqrt(c * c - 4 * m * k);
  expectSpectrum(eigenvalues(linalg::solveQuadratic({m}, {c}, {k}, 1)),
                 {(-c - root) / (2 * m), (-c + root) / (2 * m)}, 1e-14);
}

// Negative stiffness: s = ±√(−k/m), divergence without oscillation. Both count, the stable one
// first.
TEST(Dense, Divergence) {
  for (const bool companion : {false, true}) {
    const auto pairs = linalg::solveQuadratic(
        {2}, companion ? linalg::DenseMatrix{0.0} : linalg::DenseMatrix(), {-18}, 1);
    ASSERT_EQ(pairs.size(), 2u);
    EXPECT_NEAR(pairs[0].s.real(), -3, 1e-14);
    EXPECT_NEAR(pairs[1].s.real(), 3, 1e-14);
    for (const auto& pair : pairs) EXPECT_EQ(pair.s.imag(), 0);
  }
}

// Gyroscopic forces: M = I, Z = [0, −g; g, 0], K = k I whirl forwards and backwards at ω = √(k +
// g²/4) ± g/2.
TEST(Dense, Whirl) {
  const double g = 0.7, k = 4;
  const double middle = std::sqrt(k + g * g / 4);
  const auto pairs = linalg::solveQuadratic(identity2, {0, g, -g, 0}, {k, 0, 0, k}, 2);
  expectSpectrum(eigenvalues(pairs), {{0, middle - g / 2}, {0, middle + g / 2}}, 1e-14);
  for (const auto& pair : pairs)
    EXPECT_LT(residual(identity2, {0, g, -g, 0}, {k, 0, 0, k}, pair), 1e-14);
}

linalg::DenseMatrix randomMatrix(int m, double diagonal, std::mt19937& generator) {
  linalg::DenseMatrix matrix;
  for (int i = 0; i < m * m; ++i)
    matrix.push_back((i % (m + 1) == 0 ? diagonal : 0) + 2.0 * generator() / 4294967295.0 - 1);
  return matrix;
}

// Without damping the problem is linear in s²; the companion form of twice the size must say the
// same. Stiffness in Pa·m.
TEST(Dense, CompanionAgreesWithLinearInSquare) {
  std::mt19937 generator(3);
  constexpr int m = 12;
  for (const double unit : {1.0, 1e9}) {
    const linalg::DenseMatrix mass = randomMatrix(m, 8, generator);
    linalg::DenseMatrix stiffness = randomMatrix(m, 4, generator);
    for (auto& entry : stiffness) entry *= unit;
    const auto direct = linalg::solveQuadratic(mass, {}, stiffness, m),
               companion =
                   linalg::solveQuadratic(mass, linalg::DenseMatrix(m * m, 0.0), stiffness, m);
    expectSpectrum(eigenvalues(companion), eigenvalues(direct), 1e-12);
    for (std::size_t i = 1; i < direct.size(); ++i)
      EXPECT_LE(direct[i - 1].s.imag(), direct[i].s.imag());
    for (const auto& list : {direct, companion})
      for (const auto& pair : list) EXPECT_LT(residual(mass, {}, stiffness, pair), 1e-13);
  }
}

// A motion without mass has no eigenvalue; the others are found by the inverse of the stiffness.
// Nothing can be said where both are singular.
TEST(Dense, SingularMassLeavesTheFiniteEigenvalues) {
  for (const auto& damping : {linalg::DenseMatrix{}, linalg::DenseMatrix(4, 0.0)}) {
    const auto pairs = linalg::solveQuadratic({1, 0, 0, 0}, damping, {2, 0, 0, 3}, 2);
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_NEAR(std::abs(pairs[0].s - Complex(0, std::sqrt(2.0))), 0, 1e-14);
  }
  EXPECT_NE(test::errorOf([] { linalg::solveQuadratic({1, 0, 0, 0}, {}, {2, 0, 0, 0}, 2); }), "");
}

OwnedMat matrix(PetscInt size, const std::vector<std::tuple<PetscInt, PetscInt, double>>& entries) {
  OwnedMat result;
  check(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, size, size, 4, nullptr, 4,
                     nullptr, result.out()));
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(result, &first, &end));
  for (const auto& [row, column, value] : entries)
    if (row >= first && row < end) check(MatSetValue(result, row, column, value, INSERT_VALUES));
  check(MatAssemblyBegin(result, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(result, MAT_FINAL_ASSEMBLY));
  return result;
}

/// A chain of independent pairs, each with a critical friction of its own, as the terms K0 + f K1 +
/// s² M.
constexpr PetscInt pairCount = 12;
Oscillators pairOf(PetscInt j) { return {1.0 + 0.9 * double(j), 1.2 + 0.93 * double(j), 1.0}; }

pencil::Pencil chain() {
  std::vector<std::tuple<PetscInt, PetscInt, double>> k0, k1, m;
  for (PetscInt j = 0; j < pairCount; ++j) {
    const auto o = pairOf(j);
    k0.insert(k0.end(), {{2 * j, 2 * j, o.k1}, {2 * j + 1, 2 * j + 1, o.k2}});
    k1.insert(k1.end(), {{2 * j, 2 * j + 1, o.k3}, {2 * j + 1, 2 * j, -o.k3}});
    m.insert(m.end(), {{2 * j, 2 * j, 1}, {2 * j + 1, 2 * j + 1, 1}});
  }
  std::vector<pencil::Term> terms;
  terms.push_back({matrix(2 * pairCount, k0), 0, 0, 1});
  terms.push_back({matrix(2 * pairCount, k1), 0, 1, 1});
  terms.push_back({matrix(2 * pairCount, m), 2, 0, 1});
  return pencil::Pencil(std::move(terms));
}

void expectChain(const pencil::ComplexModes& point) {
  std::vector<Complex> wanted;
  int unstable = 0;
  for (PetscInt j = 0; j < pairCount; ++j) {
    for (const auto& s : pairOf(j).exact(point.at.friction)) wanted.push_back(s);
    unstable += point.at.friction > pairOf(j).critical();
  }
  expectSpectrum(test::eigenvaluesOf(point), wanted, 1e-11);
  EXPECT_EQ(point.unstableCount(), unstable);
  EXPECT_LT(point.worstBackwardError(), 1e-14);
  EXPECT_EQ(static_cast<int>(point.shapes.size()), std::min(unstable, 3));  // -flutter_shapes
  for (std::size_t i = 1; i < point.shapes.size(); ++i)
    EXPECT_GE(point.eigenvalues[point.shapes[i - 1].index].s.real(),
              point.eigenvalues[point.shapes[i].index].s.real());
}

/// The unit matrix: unknowns are displacements.
OwnedMat identity() {
  std::vector<std::tuple<PetscInt, PetscInt, double>> entries;
  for (PetscInt i = 0; i < 2 * pairCount; ++i) entries.emplace_back(i, i, 1);
  return matrix(2 * pairCount, entries);
}

// Critical frictions of the chain: 0.1 + 0.015 j.
TEST(Sweep, DirectMethodIsExact) {
  test::setOptions("-flutter_direct_count 24");
  const auto pencil = chain();
  const auto trial = identity();
  for (const double f : {0.0, 0.12, 0.2, 0.6}) expectChain(direct::solveDirect(pencil, {f}, trial));
}

double largestSingularValue(test::DenseCopy a) {
  PetscBLASInt n = a.rows, one = 1, length = 40 * n, info = 0;
  std::vector<double> values(static_cast<std::size_t>(n)), work(static_cast<std::size_t>(length));
  LAPACKgesvd_("N", "N", &n, &n, a.values.data(), &n, values.data(), nullptr, &one, nullptr, &one,
               work.data(), &length, &info);
  EXPECT_EQ(info, 0);
  return values[0];
}

/// The eigenvalues of all unknowns, by LAPACK.
std::vector<linalg::DensePair> fullOrder(const pencil::Pencil& pencil, double friction) {
  const auto stiffness = test::denseCopy(pencil.assembled(0, {friction})),
             mass = test::denseCopy(pencil.assembled(2, {friction}));
  return linalg::solveQuadratic(mass.values, {}, stiffness.values,
                                static_cast<int>(stiffness.rows));
}

// Sixty free modes of the layers' 156 unknowns, corrected by their residuals: the band holds the
// eigenvalues of the full order.
TEST(Sweep, CorrectedReductionIsThatOfTheFullOrder) {
  const Layers layers("-modes_count 60");
  const auto pencil = flutter::affineTerms(layers.model.contact, *layers.system);
  const auto basis = layers.modes();
  reduction::ReducedProblem reduced(pencil, *layers.system, basis);
  for (const double f : {0.0, 0.2, 0.5}) {
    std::vector<reduction::PointProblem> problem;
    problem.push_back({{f}, pencil.with({})});
    const auto points = reduced.solve(problem, layers.system->transformation().trial);
    const auto& point = points.at(0);
    const double top = (1 - 1e-6) * point.bandTop;  // rounding decides what is on the edge
    std::vector<Complex> wanted, found;
    for (const auto& pair : fullOrder(pencil, f))
      if (std::abs(pair.s) <= top) wanted.push_back(pair.s);
    for (const auto& eigenvalue : point.eigenvalues)
      if (std::abs(eigenvalue.s) <= top) found.push_back(eigenvalue.s);
    int unstable = 0;
    for (const auto& s : wanted) unstable += s.real() > 1e-6 * std::abs(s);
    const auto errors = test::errors(wanted, found);
    test::print(
        "reduced, f = %g: %d in the band, basis %d, worst error %.1e, worst backward error %.1e\n",
        f, static_cast<int>(wanted.size()), static_cast<int>(reduced.basisSize()),
        test::worst(errors.relative), point.worstBackwardError());
    EXPECT_GT(wanted.size(), 15u);
    EXPECT_EQ(found.size(), wanted.size());
    // Backward errors of 1e-9, -flutter_accuracy, move well separated eigenvalues by some hundred
    // times as much at most.
    EXPECT_LT(test::worst(errors.relative), 1e-6);
    EXPECT_LE(point.worstBackwardError(), point.accuracy);
    EXPECT_EQ(point.unstableCount(), unstable);
    EXPECT_EQ(unstable > 0, f > 0);
  }
}

// A band asked for above the free modes ends between the last two: corrections are those of
// eigenvalues found, and at friction 0, where the free modes are exact, none would lead to one
// above them. Each point on a basis of its own: none helps the next.
TEST(Sweep, BandEndsWithTheFreeModes) {
  const Layers layers("-modes_count 60 -flutter_band 1000");
  const auto pencil = flutter::affineTerms(layers.model.contact, *layers.system);
  const auto basis = layers.modes();
  const auto& w = basis.angularFrequency;
  for (const double f : {0.0, 0.05, 0.5}) {
    reduction::ReducedProblem reduced(pencil, *layers.system, basis);
    std::vector<reduction::PointProblem> problem;
    problem.push_back({{f}, pencil.with({})});
    const auto points = reduced.solve(problem, layers.system->transformation().trial);
    const auto& point = points.at(0);
    EXPECT_GT(point.bandTop, w.at(w.size() - 3));  // the last two may be a double mode
    EXPECT_LT(point.bandTop, w.back());
    const auto exact = fullOrder(pencil, f);
    const auto wanted = std::count_if(exact.begin(), exact.end(), [&](const auto& pair) {
      return std::abs(pair.s) <= point.bandTop;
    });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(point.eigenvalues.size()), wanted) << "friction " << f;
    EXPECT_EQ(point.uncertifiedCount(), 0);
  }
}

// From below, so that no backward error is flattered, and not far below.
TEST(Norm, IsJustBelowTheLargestSingularValue) {
  const Layers layers;
  const auto pencil = flutter::affineTerms(layers.model.contact, *layers.system);
  EXPECT_EQ(pencil.norm(1, {0.3}), 0);  // no damping
  for (const int power : {0, 2})
    for (const double f : {0.0, 0.3, 0.5, 2.0}) {
      const double exact = largestSingularValue(test::denseCopy(pencil.assembled(power, {f}))),
                   estimate = pencil.norm(power, {f});
      test::print("norm of the terms in s^%d at f = %g: estimate / exact = %.4f\n", power, f,
                  estimate / exact);
      EXPECT_LE(estimate, (1 + 1e-12) * exact);
      EXPECT_GE(estimate, 0.95 * exact);
    }
}

// A term that is zero at the first friction of a sweep, as friction-induced damping is at f = 0,
// has a norm at the next.
TEST(Norm, RecoversFromAVanishingTerm) {
  std::vector<pencil::Term> terms;
  terms.push_back({matrix(2, {{0, 0, 3}, {1, 1, -5}}), 1, 1, 1});
  const pencil::Pencil pencil(std::move(terms));
  EXPECT_EQ(pencil.norm(1, {0}), 0);
  EXPECT_NEAR(pencil.norm(1, {0.5}), 2.5, 0.05 * 2.5);
}

// Exact eigenpairs of the layers, from LAPACK on all their unknowns, and the same pairs with s
// moved by a known step:
//   P(s + δ) d = (2 s δ + δ²) M̄ d.
TEST(BackwardError, OfExactAndOfPerturbedPairs) {
  constexpr double friction = 0.4;
  const Layers layers;
  const auto pencil = flutter::affineTerms(layers.model.contact, *layers.system);
  const auto mass = test::denseCopy(pencil.assembled(2, {friction}));
  const double stiffnessNorm =
                   largestSingularValue(test::denseCopy(pencil.assembled(0, {friction}))),
               massNorm = largestSingularValue(mass);
  const auto pairs = fullOrder(pencil, friction);
  EXPECT_TRUE(std::any_of(pairs.begin(), pairs.end(), [](const auto& pair) {
    return pair.s.real() > 1e-3;
  }));  // complex ones among them
  linalg::ComplexVector d;
  check(MatCreateVecs(layers.system->k0(), d.real.out(), d.imaginary.out()));
  double worst = 0;
  for (std::size_t k = 0; k < pairs.size(); k += 7) {
    const auto& s = pairs[k].s;
    const auto& q = pairs[k].q;
    Complex moved = 0;
    double length = 0;
    for (std::size_t i = 0; i < q.size(); ++i) {
      check(VecSetValue(d.real, static_cast<PetscInt>(i), q[i].real(), INSERT_VALUES));
      check(VecSetValue(d.imaginary, static_cast<PetscInt>(i), q[i].imag(), INSERT_VALUES));
      moved = 0;
      for (std::size_t j = 0; j < q.size(); ++j)
        moved += mass(static_cast<PetscInt>(i), static_cast<PetscInt>(j)) * q[j];
      length += std::norm(moved);
    }
    for (Vec part : {d.real.get(), d.imaginary.get()})
      check(VecAssemblyBegin(part)), check(VecAssemblyEnd(part));
    worst = std::max(worst, pencil::backwardError(pencil, {friction}, s, d));
    for (const Complex step : {Complex(1e-3, 0), Complex(0, -1e-6), Complex(2e-9, 1e-9)}) {
      const Complex delta = step * std::abs(s), there = s + delta;
      const double size = std::abs(there);
      const double exact = std::abs(2.0 * s * delta + delta * delta) * std::sqrt(length) /
                           (size * size * massNorm + stiffnessNorm);
      EXPECT_NEAR(pencil::backwardError(pencil, {friction}, there, d), exact,
                  0.05 * exact);  // norms are estimates
    }
  }
  test::print("backward error of LAPACK's pairs, %d unknowns: %.1e\n", static_cast<int>(mass.rows),
              worst);
  EXPECT_LT(worst,
            1e-14);  // rounding of a backward stable method, a few units times a power of the size
}

// s = 0 is an eigenvalue like any other.
TEST(BackwardError, OfARealVectorAndOfZero) {
  std::vector<pencil::Term> terms;
  terms.push_back({matrix(2, {{0, 0, 4}}), 0, 0, 1});
  terms.push_back({matrix(2, {{0, 0, 1}, {1, 1, 1}}), 2, 0, 1});
  const pencil::Pencil pencil(std::move(terms));
  linalg::ComplexVector d;
  check(MatCreateVecs(pencil.terms()[0].matrix, d.real.out(), d.imaginary.out()));
  check(VecZeroEntries(d.imaginary));
  const auto set = [&](double a, double b) {
    check(VecSetValue(d.real, 0, a, INSERT_VALUES));
    check(VecSetValue(d.real, 1, b, INSERT_VALUES));
    check(VecAssemblyBegin(d.real));
    check(VecAssemblyEnd(d.real));
  };
  set(3, 0);
  EXPECT_LT(pencil::backwardError(pencil, {}, {0, 2}, d), 1e-15);
  EXPECT_NEAR(pencil::backwardError(pencil, {}, {0, 1}, d), (4 - 1) / (1.0 * 1 + 4), 1e-6);
  set(0, 5);
  EXPECT_LT(pencil::backwardError(pencil, {}, 0, d), 1e-15);
}

}  // namespace
}  // namespace squeal
