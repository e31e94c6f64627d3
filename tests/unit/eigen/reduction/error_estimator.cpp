// SPDX-License-Identifier: BSD-2-Clause
// Estimates of errors, by hand and against the problem of all unknowns, and the corrections that
// they ask for.
#include "eigen/reduction/error_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eigen/pencil/band.hpp"
#include "eigen/reduction/corrector.hpp"
#include "eigen/reduction/point_norms.hpp"
#include "problem/terms/terms.hpp"
#include "support/algebra/blocks.hpp"
#include "support/algebra/quadratic.hpp"
#include "support/algebra/sparse.hpp"
#include "support/algebra/symmetric.hpp"
#include "support/eigen/full_problem.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/problem/coarse_layers.hpp"

namespace squeal::test {
namespace {

using linalg::DensePair;
using reduction::PairErrors;
using reduction::PointSolution;
using reduction::PointState;

/// Two layers at friction 0.5 in the basis of 40 free modes.
struct Fixture : Layers {
  pencil::Pencil pencil;
  modes::Modes free;
  reduction::ProjectedBasis basis;
  reduction::Settings settings;
  reduction::ErrorEstimator estimator;
  reduction::Corrector corrector;
  reduction::PointProblem point;
  PointState state;
  double top;  // rad/s
  Fixture()
      : Layers("-modes_count 40"),
        pencil(terms::affineTerms(model.contact, *system)),
        free(modes()),
        basis(pencil, *system, free, {}),
        settings(reduction::Settings::given(pencil::Settings::given())),
        estimator(basis, free.angularFrequency, settings),
        corrector(basis, estimator),
        point{{0.5}, pencil.with({})},
        state(first()),
        top(pencil::bandBelow(free.angularFrequency, 0)) {}
  PointState first() {
    basis.addSet(pencil, {});
    return basis.state(point, reduction::PointNorms().compute(point));
  }
  /// Solves the problem in the present basis and estimates the errors of the band.
  void solve() {
    basis.extend({&state});
    const auto problem = basis.project(state);
    state.solution.spectrum.band = linalg::solveQuadratic(
        problem, linalg::Vectors::both, [&](Complex s) { return std::abs(s) <= top; });
    estimator.estimate(state, problem);
  }
  double lowest() const { return free.angularFrequency.front(); }
};

/// The solution of one eigenvalue with errors given by hand.
PointSolution solution(Complex s, const PairErrors& errors,
                       pencil::Symmetry symmetry = pencil::Symmetry::none) {
  PointSolution one;
  one.spectrum.band = {{s, {}, {}}};
  one.errors = {errors};
  one.symmetry = symmetry;
  return one;
}

// |δs| = |s| (right · min(1, left) + dense). In a problem in s² an error δ of s² moves s by at most
// √δ, here √(2 · 0.02) |s| = 0.2 |s| instead of 0.02 |s| where s is smaller than its unit, 1e-8 of
// the lowest free mode.
TEST(ErrorEstimator, AbsoluteErrors) {
  Fixture f;
  const auto of = [&](Complex s, const PairErrors& errors, pencil::Symmetry symmetry) {
    return f.estimator.absoluteError(solution(s, errors, symmetry), 0);
  };
  const PairErrors errors{.right = 0.1, .left = 0.15, .dense = 0.005},
      aboveTheModes{.right = 0.1, .left = INFINITY, .dense = 0.005};
  for (const auto symmetry :
       {pencil::Symmetry::none, pencil::Symmetry::even, pencil::Symmetry::conservative})
    EXPECT_DOUBLE_EQ(of({3, 4}, errors, symmetry), 5 * 0.02);
  EXPECT_DOUBLE_EQ(of({3, 4}, aboveTheModes, pencil::Symmetry::none), 5 * 0.105);
  const double unit = 1e-8 * f.lowest();
  EXPECT_DOUBLE_EQ(of(0, errors, pencil::Symmetry::none), unit * 0.02);
  EXPECT_DOUBLE_EQ(of(0, errors, pencil::Symmetry::even), unit * 0.2);
  // With a relative error of 3, that of the root, √6 |s|, is the smaller one.
  EXPECT_DOUBLE_EQ(of({3, 4}, {.dense = 3}, pencil::Symmetry::even), 5 * std::sqrt(6));
}

// The error relative to s; if s may be zero, relative to the lowest free mode, in s or in s².
TEST(ErrorEstimator, ExactEnough) {
  Fixture f;
  const double w = f.lowest(), tolerance = f.settings.tolerance;
  ASSERT_EQ(tolerance, 1e-8);
  const auto is = [&](Complex s, double error, pencil::Symmetry symmetry) {
    pencil::Eigenvalue e{.s = s, .error = error};
    return f.estimator.isExactEnough(solution(s, {}, symmetry), e);
  };
  EXPECT_TRUE(is({0, 2}, 1.9 * tolerance, pencil::Symmetry::none));
  EXPECT_FALSE(is({0, 2}, 2.1 * tolerance, pencil::Symmetry::none));
  EXPECT_TRUE(is(0, 0.9 * tolerance * w, pencil::Symmetry::none));
  EXPECT_FALSE(is(0, 1.1 * tolerance * w, pencil::Symmetry::none));
  EXPECT_TRUE(is(0, 0.9e-4 * w, pencil::Symmetry::even));  // its square is 0.81e-8
  EXPECT_FALSE(is(0, 1.1e-4 * w, pencil::Symmetry::even));
}

// The larger of the backward error over 1e-9 and the error of the basis over 1e-8, however small
// the backward error is; nothing if only round-off is left, and nothing if all is accepted.
TEST(ErrorEstimator, RatiosToTheTolerances) {
  Fixture f;
  ASSERT_EQ(f.settings.criteria.accuracy, 1e-9);
  const auto ratio = [&](const PairErrors& errors) {
    return f.estimator.errorRatio(solution({0, 1}, errors), 0);
  };
  EXPECT_DOUBLE_EQ(ratio({.backward = 2e-9, .right = 1e-5, .left = 1e-3}), 2);
  EXPECT_DOUBLE_EQ(ratio({.backward = 2e-9, .right = 1e-5, .left = 3e-3}), 3);
  EXPECT_DOUBLE_EQ(ratio({.backward = 2e-9, .right = 7e-8, .left = INFINITY}), 7);
  EXPECT_DOUBLE_EQ(ratio({.backward = 9e-15, .right = 7e-8, .left = INFINITY}), 7);
  EXPECT_EQ(ratio({.backward = 2e-9, .right = 1, .left = 1, .isRoundOff = true}), 0);
  // The dense solve leaves 3e-9, less than a tenth, or nothing of the 1e-8.
  EXPECT_DOUBLE_EQ(ratio({.right = 6e-9, .left = INFINITY, .dense = 7e-9}), 2);
  EXPECT_DOUBLE_EQ(ratio({.right = 6e-9, .left = INFINITY, .dense = 9.5e-9}), 6);
  EXPECT_DOUBLE_EQ(ratio({.right = 7e-8, .left = INFINITY, .dense = 2e-8}), 7);
  EXPECT_TRUE(f.estimator.isAccurate(solution({0, 1}, {.backward = 0.99e-9})));
  EXPECT_FALSE(f.estimator.isAccurate(solution({0, 1}, {.backward = 1.01e-9})));
  f.estimator.acceptAll();
  EXPECT_EQ(ratio({.backward = 1, .right = 1, .left = 1}), 0);
}

// The backward errors of all pairs from sketches of 64 signs: the estimate of each norm is off by
// at most three deviations of 9 %, and the residual is raised by 27 %, so that the ratio to the
// exact one is between 0.73/1.27 · 1.27 and 1.27/0.73 · 1.27. Friction does not act on some modes,
// whose residuals are round-off.
TEST(ErrorEstimator, BackwardErrorsAreThoseOfAllUnknowns) {
  Fixture f;
  f.solve();
  const auto& band = f.state.solution.spectrum.band;
  ASSERT_GT(band.size(), 20U);
  int compared = 0;
  for (std::size_t j = 0; j < band.size(); ++j) {
    const auto x = std::move(f.basis.basis().expand({band[j].q})[0]);
    const double exact = pencil::backwardError(f.pencil, {0.5}, band[j].s, x),
                 ratio = f.state.solution.errors[j].backward / exact;
    if (exact < 1e-12) {
      EXPECT_LT(f.state.solution.errors[j].backward, 2.21e-12);
      continue;
    }
    ++compared;
    EXPECT_GT(ratio, 0.73);
    EXPECT_LT(ratio, 2.21);
  }
  EXPECT_GT(compared, 10);
}

// The estimates of |δs| of the confirmed pairs bound the errors against the eigenvalues of all
// unknowns. Above the free modes there is no bound on left vectors, and without the modes in the
// basis no such place at all.
TEST(ErrorEstimator, EstimatesBoundTheErrors) {
  Fixture f;
  f.solve();
  std::vector<PointState> states;
  states.push_back(std::move(f.state));
  PointState& state = states[0];
  EXPECT_EQ(f.estimator.unconfirmed(states).size(), 1U);  // the modes alone are not accurate
  const auto exact = eigenvaluesOf(linalg::solveQuadratic(fullProblem(f.pencil, {0.5})));
  const auto found = eigenvaluesOf(state.solution.spectrum.band);
  const auto nearest = matched(found, exact);
  double worst = 0;
  for (std::size_t j = 0; j < found.size(); ++j) {
    const double error = std::abs(found[j] - nearest[j]);
    EXPECT_LT(error, f.estimator.absoluteError(state.solution, j)) << found[j];
    worst = worse(worst, error / std::abs(found[j]));
    EXPECT_TRUE(std::isfinite(state.solution.errors[j].left));
  }
  EXPECT_GT(worst, 1e-6);  // else the bound says nothing
  f.estimator.dropModes();
  f.estimator.estimate(state, f.basis.project(state));
  for (const auto& errors : state.solution.errors) EXPECT_TRUE(std::isinf(errors.left));
}

// The pairs above the tolerance, without those that are mirror images of one before, each to be
// resolved to √2 · 0.03 of the ratio, at most wholly.
TEST(Corrector, AsksForThePairsAboveTheTolerance) {
  Fixture f;
  const std::vector<Complex> q(f.basis.basis().size(), 1.0);
  auto& solution = f.state.solution;
  for (const Complex s : {Complex(0, 1), Complex(-0.1, 2), Complex(0.1, 2), Complex(0, 3)})
    solution.spectrum.band.push_back({s, q, q});
  solution.errors = {
      {.backward = 0.5e-9}, {.backward = 5e-9}, {.backward = 5e-9}, {.backward = 1e-7}};
  const auto request = f.corrector.requestOf(f.state);
  ASSERT_EQ(request.pairs.pairs.pairs.size(), 2U);
  EXPECT_EQ(request.pairs.pairs.pairs[0], &solution.spectrum.band[1]);
  EXPECT_EQ(request.pairs.pairs.pairs[1], &solution.spectrum.band[3]);
  EXPECT_EQ(request.state, &f.state);
  EXPECT_DOUBLE_EQ(request.weights[0], std::sqrt(2) * 0.03 * 5);
  EXPECT_EQ(request.weights[1], 1);  // √2 · 0.03 · 100 = 4.2
}

/// Returns the residuals of the pairs of a request, each of length 1: one column, or real and
/// imaginary part.
linalg::Block residuals(const Fixture& f, const reduction::CorrectionRequest& request) {
  linalg::Block all(f.basis.basis().localRows());
  for (const auto* pair : request.pairs.pairs.pairs) {
    const auto x = std::move(f.basis.basis().expand({pair->q})[0]);
    linalg::Block columns = f.basis.residualColumns(f.state, *pair, x, pencil::Side::right);
    double square = 0;
    for (PetscInt j = 0; j < columns.columns(); ++j)
      for (const double entry : columns.column(j)) square += entry * entry;
    const double length = std::sqrt(total(square));
    for (PetscInt j = 0; j < columns.columns(); ++j)
      for (double& entry : columns.column(j)) entry /= length;
    all.append(columns);
  }
  return all;
}

// Vectors that do not solve the reduced problem have residuals R with VᵀR ≠ 0. What is asked for is
// R − K0 V (VᵀK0V)⁻¹ VᵀR, which has none; V itself contains K0⁻¹ times the difference. V is
// orthonormal within 1e-9 or so, the square of which is below round-off.
TEST(ProjectedBasis, ResidualsAreOrthogonalToTheBasis) {
  Fixture f;
  f.solve();
  for (auto& pair : f.state.solution.spectrum.band)
    for (std::size_t i = 0; i < pair.q.size(); ++i) pair.q[i] *= 1 + 0.1 * std::sin(1.0 + i);
  const auto request = f.corrector.requestOf(f.state);
  linalg::Block whole(f.basis.basis().localRows());
  for (const auto* pair : request.pairs.pairs.pairs) {
    const auto x = std::move(f.basis.basis().expand({pair->q})[0]);
    whole.append(f.basis.residualColumns(f.state, *pair, x, pencil::Side::right));
  }
  const PetscInt count = whole.columns();
  ASSERT_GT(count, 5);
  linalg::DenseMatrix unit(count, count);
  for (PetscInt j = 0; j < count; ++j) unit(j, j) = 1;
  const linalg::Block some = f.basis.residuals({{&f.state, &request.pairs}}, unit,
                                               reduction::ProjectedBasis::Residual::outside);
  const auto along = [&](const linalg::Block& forces) {
    const auto product =
        linalg::transposedProduct(PETSC_COMM_WORLD, f.basis.basis().columns(), forces);
    return std::sqrt(linalg::squaredLength(product.entries()));
  };
  EXPECT_LT(along(some), 1e-11 * along(whole));
  linalg::Block difference = whole;
  linalg::addScaled(difference, -1, some);
  const linalg::Block nothing(whole.rows());
  EXPECT_LT(energyOutside(*f.system, f.basis.basis().columns(), difference),
            1e-7 * energyOutside(*f.system, nothing, difference));  // the root of round-off
}

// The pairs are so far from solutions of the reduced problem that less than 3 % of their residuals
// lies outside of K0 V. Without anything else, a correction must use them whole: the basis grows,
// so that the next solution starts from it.
TEST(Corrector, UsesResidualsAlongTheBasisIfNothingElseIsLeft) {
  Fixture f;
  f.corrector.start(f.point,
                    {f.free.angularFrequency.begin(), f.free.angularFrequency.begin() + 30});
  for (int round = 0; round < 3; ++round) {  // until hardly anything is outside
    f.solve();
    f.corrector.correct({f.corrector.requestOf(f.state)});
  }
  f.solve();
  auto& band = f.state.solution.spectrum.band;
  const auto solved = band;
  for (std::size_t j = 0; j < band.size(); ++j)  // a part of another eigenvector
    for (std::size_t i = 0; i < band[j].q.size(); ++i)
      band[j].q[i] += solved[(j + 3) % band.size()].q[i];
  std::vector<const DensePair*> pairs;
  for (const auto& pair : band) pairs.push_back(&pair);
  const reduction::CorrectionRequest request{&f.state, f.state.pairs(pairs, f.state.damped),
                                             std::vector<double>(pairs.size(), 1.0)};
  linalg::DenseMatrix unit(request.pairs.pairs.columns, request.pairs.pairs.columns);
  for (PetscInt j = 0; j < unit.columns(); ++j) unit(j, j) = 1;
  const auto squares = [&](reduction::ProjectedBasis::Residual kind) {  // [pair]
    const linalg::Block r = f.basis.residuals({{&f.state, &request.pairs}}, unit, kind);
    std::vector<double> ofColumns;
    for (PetscInt j = 0; j < r.columns(); ++j)
      ofColumns.push_back(std::pow(linalg::length(PETSC_COMM_WORLD, r.column(j)), 2));
    return request.pairs.pairs.perPair(ofColumns);
  };
  const auto outside = squares(reduction::ProjectedBasis::Residual::outside),
             whole = squares(reduction::ProjectedBasis::Residual::whole);
  double sum = 0;  // of the squared fractions outside, at least the largest square of a direction
  for (std::size_t i = 0; i < pairs.size(); ++i) sum += outside[i] / whole[i];
  ASSERT_LT(std::sqrt(sum), 0.03);
  EXPECT_GT(f.corrector.correct({request}), 0);
}

// After a correction with all residuals r asked for wholly, what K0⁻¹ r/‖r‖ has outside of the
// basis comes from a part of r/‖r‖ of length 0.03 at most; its energy norm is at most 0.03 over the
// root of the lowest eigenvalue of K0. The residuals of the next solution are smaller.
TEST(Corrector, AddsTheResponsesToTheResiduals) {
  Fixture f;
  f.corrector.start(f.point,
                    {f.free.angularFrequency.begin(), f.free.angularFrequency.begin() + 30});
  f.solve();
  const double lowest = symmetricEigenvalues(denseCopy(f.system->k0())).front(),
               bound = 0.03 / std::sqrt(lowest);
  double worst = 0;
  for (const auto& errors : f.state.solution.errors) worst = worse(worst, errors.backward);
  const auto request = f.corrector.requestOf(f.state);
  ASSERT_GT(request.weights.size(), 5U);
  EXPECT_EQ(*std::ranges::min_element(request.weights), 1);  // all are asked for wholly
  const linalg::Block forces = residuals(f, request);
  const double before = energyOutside(*f.system, f.basis.basis().columns(), forces);
  const PetscInt size = f.basis.basis().size(), added = f.corrector.correct({request});
  EXPECT_GT(added, 0);
  EXPECT_LE(added, forces.columns());
  EXPECT_EQ(f.basis.basis().size(), size + added);
  const double after = energyOutside(*f.system, f.basis.basis().columns(), forces);
  print("%d residuals, %d vectors: outside before %.2e, after %.2e, bound %.2e\n",
        int(forces.columns()), int(added), before, after, bound);
  EXPECT_LT(after, bound);
  EXPECT_GT(before, 2 * bound);  // else the bound says nothing
  f.solve();
  double next = 0;
  for (const auto& errors : f.state.solution.errors) next = worse(next, errors.backward);
  print("backward errors up to %.1e, then %.1e\n", worst, next);
  EXPECT_LT(next, 0.3 * worst);
}

}  // namespace
}  // namespace squeal::test
