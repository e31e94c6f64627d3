// SPDX-License-Identifier: BSD-2-Clause
// Eigenpairs of a problem of a smaller basis improved in a larger one, and eigenvalues that are
// missing in a list. The answers are those of LAPACK for the whole problem.
#include "eigen/reduction/eigenpair_correction.hpp"

#include <gtest/gtest.h>

#include "eigen/reduction/missing.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/quadratic.hpp"
#include "support/eigen/modal_brake.hpp"
#include "support/eigen/spectrum.hpp"

namespace squeal::test {
namespace {

using linalg::DenseMatrix;
using linalg::DensePair;
using linalg::DenseProblem;

constexpr PetscInt order = 60, known = 45;
constexpr double top = 20;

bool inBand(Complex s) { return std::abs(s) <= top; }

DenseProblem brake(double friction) { return modalBrake(order, friction, Damping::random); }

std::vector<DensePair> pairsOf(const DenseProblem& problem) {
  return linalg::solveQuadratic(problem, linalg::Vectors::both,
                                [](Complex s) { return std::abs(s) <= 1.3 * top; });
}

std::vector<reduction::UnconvergedPair> bandOpen(const std::vector<DensePair>& pairs, double part) {
  std::vector<reduction::UnconvergedPair> open;
  for (std::size_t j = 0; j < pairs.size(); ++j)
    if (inBand(pairs[j].s)) open.push_back({j, part, 0.1});
  return open;
}

bool improved(const DenseProblem& problem, std::vector<DensePair>& pairs,
              const std::vector<reduction::UnconvergedPair>& open) {
  return reduction::correctPairs(PETSC_COMM_WORLD, {{&problem, &pairs, open}})[0];
}

std::vector<DensePair> bandOf(std::vector<DensePair> pairs) {
  std::erase_if(pairs, [](const auto& pair) { return !inBand(pair.s); });
  return pairs;
}

// Each call leaves a tenth of the residuals, until they are rounding. The eigenvalues are then
// those of the whole problem.
TEST(Refinement, ImprovesPairsOfASmallerBasis) {
  const DenseProblem problem = brake(0.02);
  auto pairs = pairsOf(leading(problem, known));
  for (auto& pair : pairs) pair.q.resize(order);
  for (int round = 0; round < 14; ++round) {
    const double before = worstResidual(problem, bandOf(pairs));
    ASSERT_TRUE(improved(problem, pairs, bandOpen(pairs, 0.1))) << "round " << round;
    EXPECT_LT(worstResidual(problem, bandOf(pairs)), 0.1 * before + 1e-13) << "round " << round;
  }
  EXPECT_LT(worstLeftResidual(problem, bandOf(pairs)), 1e-13);
  expectSpectrum(eigenvaluesOf(bandOf(pairs)), eigenvaluesOf(bandOf(pairsOf(problem))), 1e-12);
}

// Pairs that are not open stay as they are, except for the zeros that extend them.
TEST(Refinement, LeavesOtherPairs) {
  const DenseProblem problem = brake(0.02);
  auto pairs = pairsOf(leading(problem, known));
  const auto before = pairs;
  ASSERT_TRUE(improved(problem, pairs, {{3, 0.1, 0.1}, {9, 0.1, 0.1}}));
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    EXPECT_EQ(pairs[j].s == before[j].s, j != 3 && j != 9) << j;
    if (j == 3 || j == 9) continue;
    auto q = before[j].q;
    q.resize(order);
    EXPECT_EQ(pairs[j].q, q) << j;
  }
}

// Two copies of one pair cannot both be right.
TEST(Refinement, RefusesPairsThatMeet) {
  const DenseProblem problem = brake(0.02);
  auto pairs = pairsOf(problem);
  pairs.push_back(pairs[4]);
  EXPECT_FALSE(improved(problem, pairs, {{2, 0.1, 0.1}}));
}

// Several problems at once, of which one cannot be improved.
TEST(Refinement, ImprovesProblemByProblem) {
  const std::vector<DenseProblem> problems{brake(0.02), brake(0.021), brake(0.03)};
  std::vector<std::vector<DensePair>> pairs;
  std::vector<reduction::CorrectionTask> tasks;
  for (const auto& problem : problems) pairs.push_back(pairsOf(leading(problem, known)));
  pairs[1].push_back(pairs[1][4]);  // a pair twice
  for (std::size_t i = 0; i < problems.size(); ++i)
    tasks.push_back({&problems[i], &pairs[i], bandOpen(pairs[i], 0.01)});
  EXPECT_EQ(reduction::correctPairs(PETSC_COMM_WORLD, tasks), (std::vector{true, false, true}));
  for (const std::size_t i : {0, 2})
    expectSpectrum(eigenvaluesOf(bandOf(pairs[i])), eigenvaluesOf(bandOf(pairsOf(problems[i]))),
                   1e-4);
}

// All ranks have the same pairs, to the last bit.
TEST(Refinement, RanksAgree) {
  const DenseProblem problem = brake(0.02);
  auto pairs = pairsOf(leading(problem, known));
  ASSERT_TRUE(improved(problem, pairs, bandOpen(pairs, 0.1)));
  for (const auto& pair : pairs) {
    Complex first = pair.q[order - 1];
    MPI_Bcast(&first, 1, MPI_C_DOUBLE_COMPLEX, 0, PETSC_COMM_WORLD);
    EXPECT_EQ(pair.q[order - 1], first);
  }
}

// Each eigenvalue of the band in turn is left out of the list. It is found to within a tenth of its
// distance from the shift, or the second shift finds it.
TEST(Refinement, FindsWhatIsMissing) {
  const std::vector<Complex> shifts = {{0, 0.25 * top}, {0, 0.75 * top}};
  for (const double friction : {0.02, 0.1}) {
    const DenseProblem problem = brake(friction);
    const auto all = pairsOf(problem);
    const auto missingIn = [&](const std::vector<DensePair>& pairs) {
      std::optional<Complex> found;
      for (const Complex shift : shifts)
        if (!found) found = reduction::findMissing(problem, pairs, shift, inBand);
      return found;
    };
    EXPECT_FALSE(missingIn(all));
    for (std::size_t j = 0; j < all.size(); ++j) {
      auto pairs = all;
      pairs.erase(pairs.begin() + j);
      const auto found = missingIn(pairs);
      if (!inBand(all[j].s)) continue;
      ASSERT_TRUE(found) << all[j].s;
      double distance = top;
      for (const Complex shift : shifts) distance = std::min(distance, std::abs(all[j].s - shift));
      EXPECT_LT(std::abs(*found - all[j].s), 0.1 * top) << all[j].s;
    }
  }
}

}  // namespace
}  // namespace squeal::test
