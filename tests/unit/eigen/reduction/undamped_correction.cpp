// SPDX-License-Identifier: BSD-2-Clause
// Watched eigenpairs of a problem without damping, of a smaller basis, improved in a larger one.
// The answers are those of LAPACK for the whole problem.
#include "eigen/reduction/undamped_correction.hpp"

#include <gtest/gtest.h>

#include "eigen/reduction/spectrum.hpp"
#include "support/algebra/quadratic.hpp"
#include "support/eigen/modal_brake.hpp"
#include "support/eigen/spectrum.hpp"

namespace squeal::test {
namespace {

using linalg::DensePair;
using linalg::DenseProblem;

constexpr double top = 20;

pencil::WatchedBand band() {
  pencil::WatchedBand found;
  found.top = top;
  return found;
}

bool isWatched(Complex s) { return band().watches(s); }

DenseProblem brake(PetscInt order, double friction) {
  return modalBrake(order, friction, Damping::none);
}

std::vector<DensePair> pairsOf(const DenseProblem& problem) {
  return linalg::solveQuadratic(problem, linalg::Vectors::both, isWatched);
}

std::vector<DensePair> bandOf(std::vector<DensePair> pairs) {
  std::erase_if(pairs, [](const auto& pair) { return !band().contains(pair.s); });
  std::ranges::sort(pairs, [](const auto& a, const auto& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  return pairs;
}

std::optional<std::vector<DensePair>> improved(const DenseProblem& problem,
                                               const std::vector<DensePair>& pairs, double part) {
  std::vector<reduction::UnconvergedPair> open;
  for (std::size_t j = 0; j < pairs.size(); ++j)
    if (band().contains(pairs[j].s)) open.push_back({j, part, 0.1});
  return reduction::correctedUndamped(problem, pairs, open, isWatched);
}

// Each call leaves a tenth of the residuals, until they are rounding: first with all eigenvalues
// imaginary, then with unstable ones, whose pairs −s̄ are listed with them. Rounding is below 1e-13
// with OpenBLAS's code for Haswell, and 1.8e-13 with that for SkylakeX.
TEST(UndampedCorrection, ImprovesPairsOfASmallerBasis) {
  for (const double friction : {0.01, 0.05}) {
    const DenseProblem problem = brake(60, friction);
    auto pairs = pairsOf(leading(problem, 45));
    for (auto& pair : pairs) pair.q.resize(problem.order());
    for (int round = 0; round < 14; ++round) {
      const double before = worstResidual(problem, bandOf(pairs));
      const auto next = improved(problem, pairs, 0.1);
      ASSERT_TRUE(next) << "round " << round;
      pairs = *next;
      EXPECT_LT(worstResidual(problem, bandOf(pairs)), 0.1 * before + 1e-12) << "round " << round;
    }
    const auto found = bandOf(pairs), exact = bandOf(pairsOf(problem));
    EXPECT_LT(worstLeftResidual(problem, found), 1e-12);
    expectSpectrum(eigenvaluesOf(found), eigenvaluesOf(exact), 1e-12);
    const bool unstable =
        std::ranges::any_of(exact, [](const auto& pair) { return pair.s.real() > 1e-3; });
    EXPECT_EQ(unstable, friction == 0.05);  // else the case does not show it
    for (std::size_t j = 0; j < found.size(); ++j)
      if (found[j].s.real() > 0 && found[j].s.imag() > 0) {
        EXPECT_EQ(found.at(j - 1).s, -std::conj(found[j].s));
      }
  }
}

// Two eigenvalues t of K⁻¹M are about to meet: they differ by 1e-5 of their size, and their vectors
// by as much. Weak coupling with the new vectors moves them by more than that.
TEST(UndampedCorrection, FollowsANearlyDefectivePair) {
  DenseProblem problem = brake(60, 1e-4);
  for (PetscInt j = 0; j < 45; ++j)
    for (PetscInt i = 0; i < 45; ++i) problem.stiffness(i, j) = i == j;
  problem.mass(4, 4) = problem.mass(5, 5);
  problem.mass(4, 5) = 0.1 * problem.mass(5, 5);
  problem.mass(5, 4) = 2.5e-10 * problem.mass(5, 5);  // t (1 ± √(0.1 · 2.5e-10))
  auto pairs = pairsOf(leading(problem, 45));
  for (int round = 0; round < 14; ++round) {
    const auto next = improved(problem, pairs, 0.1);
    ASSERT_TRUE(next) << "round " << round;
    pairs = *next;
  }
  EXPECT_LT(worstResidual(problem, bandOf(pairs)), 1e-12);
  // Round-off of 1e-15 moves them by its root.
  expectSpectrum(eigenvaluesOf(bandOf(pairs)), eigenvaluesOf(bandOf(pairsOf(problem))), 1e-7);
}

// A new vector of the basis that nothing couples with the known ones brings an eigenvalue into the
// band. Iteration cannot find it; the search for missing eigenvalues does.
TEST(UndampedCorrection, WhatEntersTheBandIsFound) {
  constexpr PetscInt order = 460, known = 445;  // smaller problems are solved in full
  DenseProblem problem = brake(order, 2e-4);
  for (PetscInt j = 0; j < order; ++j)
    if (j != known) problem.stiffness(known, j) = problem.stiffness(j, known) = 0;
  problem.stiffness(known, known) = 1;
  const DenseProblem smaller = leading(problem, known);
  reduction::Spectrum spectrum;
  reduction::solveSpectra(PETSC_COMM_WORLD, band(), {{&smaller, &spectrum, {}}});
  EXPECT_FALSE(spectrum.improved);
  const std::size_t before = spectrum.band.size();
  const std::vector<double> ratios(before, 1e3);
  for (const bool enters : {false, true}) {
    if (enters) problem.mass(known, known) = 1 / std::pow(0.6 * top + 0.3, 2);
    auto next = spectrum;
    reduction::solveSpectra(PETSC_COMM_WORLD, band(), {{&problem, &next, ratios}});
    EXPECT_TRUE(next.improved);
    EXPECT_EQ(next.band.size(), before);
    EXPECT_EQ(reduction::incomplete(PETSC_COMM_WORLD, band(), {{&problem, &next, {}}})[0], enters);
  }
}

// K is singular at the friction at which a motion becomes unstable without oscillating.
TEST(UndampedCorrection, RefusesASingularStiffness) {
  DenseProblem problem = brake(60, 0);
  const auto pairs = pairsOf(leading(problem, 45));
  problem.stiffness(50, 50) = 0;
  EXPECT_FALSE(improved(problem, pairs, 0.1));
}

}  // namespace
}  // namespace squeal::test
