// SPDX-License-Identifier: BSD-2-Clause
// Refinement of A y = b, A = diag(1, 2, …), by an inner solver for A/g: each step multiplies the
// error, and with it the residual, by 1 − g.
#include "steady/steady/iterative_refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/algebra/sparse.hpp"

namespace squeal::test {
namespace {

constexpr PetscInt size = 10;

OwnedMat diagonalOf(double factor) {
  EntryList entries;
  for (PetscInt i = 0; i < size; ++i) entries.emplace_back(i, i, factor * (i + 1));
  return matrixOf(size, entries);
}

/// Refines y = 0 with A/g as the matrix of the inner solver.
struct Refined {
  steady::Refinement result;
  std::vector<double> y;
};
Refined refined(double g, double rounding) {
  const OwnedMat a = diagonalOf(1), inner = diagonalOf(1 / g);
  OwnedKSP solver;
  PC pc = nullptr;
  check(KSPCreate(PETSC_COMM_WORLD, solver.out()));
  check(KSPSetOperators(solver, inner, inner));
  check(KSPSetType(solver, KSPPREONLY));
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCJACOBI));
  const OwnedVec y = vectorOf(a, true, std::vector<double>(size, 0));
  const auto residual = [&](Vec at) {
    steady::Residual r;
    check(VecDuplicate(at, r.vector.out()));
    check(MatMult(a, at, r.vector));
    check(VecShift(r.vector, -1));  // b = (1, …, 1)
    r.rounding = rounding;
    return r;
  };
  Refined found;
  found.result = steady::refine(solver, residual, y);
  found.y = allEntries(y);
  return found;
}

// g = 0.9: the residual falls by 10 in each step, until it is not larger than its rounding.
TEST(Refinement, GainsAsTheInnerSolverAllows) {
  const double first = std::sqrt(size);
  const auto [result, y] = refined(0.9, 2e-6 * first);
  EXPECT_EQ(result.steps, 6);
  EXPECT_DOUBLE_EQ(result.first, first);
  EXPECT_NEAR(result.least, 1e-6 * first, 1e-12 * first);  // round-off of the terms, 1
  EXPECT_NEAR(result.relative(), 1e-6, 1e-12);
  EXPECT_EQ(result.rounding, 2e-6 * first);
  EXPECT_TRUE(result.solved());
  for (PetscInt i = 0; i < size; ++i) EXPECT_NEAR(y[i], (1 - 1e-6) / (i + 1), 1e-14);
}

// g = 0.4: the residual falls to 0.6, which is more than one half, so that this step is the last.
TEST(Refinement, EndsWithAStepThatGainsLittle) {
  const auto [result, y] = refined(0.4, 0);
  EXPECT_EQ(result.steps, 1);
  EXPECT_NEAR(result.relative(), 0.6, 1e-14);
  EXPECT_FALSE(result.solved());
  for (PetscInt i = 0; i < size; ++i) EXPECT_NEAR(y[i], 0.4 / (i + 1), 1e-15);
}

// g = 2.5: the residual grows to 1.5, and the step is undone.
TEST(Refinement, UndoesAStepThatMakesItWorse) {
  const auto [result, y] = refined(2.5, 0);
  EXPECT_EQ(result.steps, 1);
  EXPECT_EQ(result.least, result.first);
  EXPECT_FALSE(result.solved());
  for (const double entry : y) EXPECT_EQ(entry, 0);
}

// g = 0.6: 20 steps leave 0.4²⁰ = 1.1e-8 of the residual, more than the 1e-9 of a solution.
TEST(Refinement, MakesAtMostTwentySteps) {
  const auto [result, y] = refined(0.6, 0);
  EXPECT_EQ(result.steps, 20);
  EXPECT_NEAR(result.relative(), std::pow(0.4, 20), 1e-14);
  EXPECT_FALSE(result.solved());
}

// A start that is the solution takes no step and has no relative residual.
TEST(Refinement, ChangesNoSolution) {
  const steady::Refinement nothing;
  EXPECT_TRUE(nothing.solved());
  EXPECT_EQ(nothing.relative(), 0);
  EXPECT_EQ(refined(0.9, 10).result.steps, 0);  // the residual of the start, 3.2, is rounding
}

}  // namespace
}  // namespace squeal::test
