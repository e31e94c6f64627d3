// SPDX-License-Identifier: BSD-2-Clause
// Flutter of problems whose eigenvalues are known: pairs of oscillators in closed form, layers by
// LAPACK on all their unknowns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/direct/direct.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sweep/sweep.hpp"
#include "problem/terms/terms.hpp"
#include "support/algebra/oscillators.hpp"
#include "support/algebra/sparse.hpp"
#include "support/eigen/full_problem.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/problem/coarse_layers.hpp"

namespace squeal {
namespace {

using test::Layers;

// Sixty free modes of the layers' 156 unknowns, corrected by their residuals: the band holds the
// eigenvalues of the full order.
TEST(Sweep, CorrectedReductionIsThatOfTheFullOrder) {
  const Layers layers("-modes_count 60");
  const auto pencil = terms::affineTerms(layers.model.contact, *layers.system);
  const auto basis = layers.modes();
  reduction::ReducedProblem reduced(pencil, *layers.system, basis,
                                    reduction::Settings::given(pencil::Settings::given()));
  for (const double f : {0.0, 0.2, 0.5}) {
    std::vector<reduction::PointProblem> problem;
    problem.push_back({{f}, pencil.with({})});
    const auto points = reduced.solve(problem, layers.system->transformation().trial);
    const auto& point = points.at(0);
    const double top = (1 - 1e-6) * point.bandTop;  // rounding decides what is on the edge
    std::vector<Complex> wanted, found;
    for (const auto& pair : linalg::solveQuadratic(test::fullProblem(pencil, {f})))
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
  const auto pencil = terms::affineTerms(layers.model.contact, *layers.system);
  const auto basis = layers.modes();
  const auto& w = basis.angularFrequency;
  for (const double f : {0.0, 0.05, 0.5}) {
    reduction::ReducedProblem reduced(pencil, *layers.system, basis,
                                      reduction::Settings::given(pencil::Settings::given()));
    std::vector<reduction::PointProblem> problem;
    problem.push_back({{f}, pencil.with({})});
    const auto points = reduced.solve(problem, layers.system->transformation().trial);
    const auto& point = points.at(0);
    EXPECT_GT(point.bandTop, w.at(w.size() - 3));  // the last two may be a double mode
    EXPECT_LT(point.bandTop, w.back());
    const auto exact = linalg::solveQuadratic(test::fullProblem(pencil, {f}));
    const auto wanted = std::count_if(exact.begin(), exact.end(), [&](const auto& pair) {
      return std::abs(pair.s) <= point.bandTop;
    });
    EXPECT_EQ(std::ssize(point.eigenvalues), wanted) << "friction " << f;
    EXPECT_EQ(point.uncertifiedCount(), 0);
  }
}

/// A chain of independent pairs, each with a critical friction of its own, as the terms K0 + f K1 +
/// s² M.
constexpr PetscInt pairCount = 12;
test::Oscillators pairOf(PetscInt j) { return {1.0 + 0.9 * j, 1.2 + 0.93 * j, 1.0}; }

pencil::Pencil chain() {
  test::EntryList k0, k1, m;
  for (PetscInt j = 0; j < pairCount; ++j) {
    const auto o = pairOf(j);
    k0.insert(k0.end(), {{2 * j, 2 * j, o.k1}, {2 * j + 1, 2 * j + 1, o.k2}});
    k1.insert(k1.end(), {{2 * j, 2 * j + 1, o.k3}, {2 * j + 1, 2 * j, -o.k3}});
    m.insert(m.end(), {{2 * j, 2 * j, 1}, {2 * j + 1, 2 * j + 1, 1}});
  }
  std::vector<pencil::Term> terms;
  terms.push_back({test::matrixOf(2 * pairCount, k0), 0, 0, 1});
  terms.push_back({test::matrixOf(2 * pairCount, k1), 0, 1, 1});
  terms.push_back({test::matrixOf(2 * pairCount, m), 2, 0, 1});
  return pencil::Pencil(std::move(terms));
}

void expectChain(const pencil::ComplexModes& point) {
  std::vector<Complex> wanted;
  int unstable = 0;
  for (PetscInt j = 0; j < pairCount; ++j) {
    for (const auto& s : pairOf(j).exact(point.at.friction)) wanted.push_back(s);
    unstable += point.at.friction > pairOf(j).critical();
  }
  test::expectSpectrum(test::eigenvaluesOf(point), wanted, 1e-11);
  EXPECT_EQ(point.unstableCount(), unstable);
  EXPECT_LT(point.worstBackwardError(), 1e-14);
  EXPECT_EQ(std::ssize(point.shapes), std::min(unstable, 3));  // -flutter_shapes
  for (std::size_t i = 1; i < point.shapes.size(); ++i)
    EXPECT_GE(point.eigenvalues[point.shapes[i - 1].index].s.real(),
              point.eigenvalues[point.shapes[i].index].s.real());
}

/// The unit matrix: unknowns are displacements.
OwnedMat identity() {
  test::EntryList entries;
  for (PetscInt i = 0; i < 2 * pairCount; ++i) entries.emplace_back(i, i, 1);
  return test::matrixOf(2 * pairCount, entries);
}

// Critical frictions of the chain: 0.1 + 0.015 j.
TEST(Sweep, DirectMethodIsExact) {
  test::setOptions("-flutter_direct_count 24");
  const auto pencil = chain();
  const auto trial = identity();
  for (const double f : {0.0, 0.12, 0.2, 0.6})
    expectChain(direct::solveDirect(pencil, {f}, trial,
                                    direct::Settings::given(pencil::Settings::given())));
}

}  // namespace
}  // namespace squeal
