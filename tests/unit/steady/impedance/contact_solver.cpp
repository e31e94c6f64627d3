// SPDX-License-Identifier: BSD-2-Clause
// The solutions of the condensed contact against their equations, with responses that the impedance
// computes one by one.
#include "steady/impedance/contact_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/harness/largest_error.hpp"
#include "support/steady/condensed_contact.hpp"
#include "support/steady/pressed_block.hpp"

namespace squeal::test {
namespace {

using impedance::ContactCase;
using impedance::ContactSolution;
using impedance::ContactVector;

// The friction is balanced to 1e-12 of its causes. Refinement would restore what the condition of
// the impedance, some hundreds, takes from that.
constexpr double tolerance = 1e-9;

/// Nodes that stick too, so that tangential displacements can be released.
const std::string stickingPad =
    floatingPad + " -contact_other_role sticking -contact_other_friction 0.4";

/// Collective. Returns Z (t, w).
ContactVector responses(const Condensed& condensed, const ContactVector& causes) {
  const auto found =
      condensed.impedance.responses(linalg::DenseView(causes.data(), std::ssize(causes), 1));
  return {found.entries().begin(), found.entries().end()};
}

/// Forces, coefficients and released unknowns without a pattern, which differ between the ranks.
ContactCase someCase(const Condensed& condensed, int number) {
  const std::size_t nodes = condensed.impedance.nodes(), length = condensed.impedance.length();
  ContactCase one;
  for (std::size_t i = 0; i < length; ++i)
    one.given.push_back(1000 * std::sin(1 + number + 1.7 * i + 10 * mpi::rank(PETSC_COMM_WORLD)));
  for (std::size_t i = 0; i < nodes; ++i)
    one.conditions.coefficient.push_back(0.1 + 0.07 * (i % 3));
  for (std::size_t i = nodes; i < length; ++i) one.conditions.free.push_back((i + number) % 3 == 0);
  return one;
}

/// Collective. Expects (R, F) = (R, F)0 + Z (t, w), t = c R, and F = 0 or w = 0 except at given
/// gaps.
void expectEquations(const Condensed& condensed, const ContactCase& one,
                     const ContactSolution& found, bool gapsAreGiven = false) {
  ASSERT_TRUE(found.found);
  const std::size_t nodes = condensed.impedance.nodes();
  const auto answers = responses(condensed, found.causes);
  double size = 0, balance = 0, friction = 0, free = 0;
  for (std::size_t i = 0; i < found.effects.size(); ++i) {
    size = worse(size, std::abs(answers[i]));
    balance = worse(balance, std::abs(one.given[i] + answers[i] - found.effects[i]));
  }
  for (std::size_t i = 0; i < nodes; ++i)
    friction = worse(friction,
                     std::abs(one.conditions.coefficient[i] * found.effects[i] - found.causes[i]));
  for (std::size_t i = gapsAreGiven ? nodes : 0; i < one.conditions.free.size(); ++i)
    if (one.conditions.free[i])
      free = worse(free, std::abs(found.effects[nodes + i]));
    else
      EXPECT_EQ(found.causes[nodes + i], 0);
  size = largest(size), balance = largest(balance), friction = largest(friction);
  free = largest(free);
  print("of %.3g N: equations %.1e, friction %.1e, free unknowns %.1e\n", size, balance / size,
        friction / size, free / size);
  EXPECT_GT(size, 1);
  EXPECT_LE(balance, tolerance * size);
  EXPECT_LE(friction, tolerance * size);
  EXPECT_LE(free, tolerance * size);
}

TEST(ContactSolver, SolvesItsEquations) {
  for (const auto& options : {pressedBlock, stickingPad}) {
    Condensed condensed(options);
    std::vector<ContactCase> cases;
    for (int number = 0; number < 3; ++number) cases.push_back(someCase(condensed, number));
    const auto found = condensed.solver.solve(cases);
    ASSERT_EQ(found.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) expectEquations(condensed, cases[i], found[i]);
  }
}

// Sets that differ by one unknown of each rank, freed or held, use the inverse of an earlier one;
// some leave a body loose. The last has an inverse of its own.
TEST(ContactSolver, SolvesOnNeighbouringSets) {
  for (const auto& options : {pressedBlock, stickingPad}) {
    Condensed condensed(options);
    std::vector<ContactCase> cases{someCase(condensed, 0)};
    for (const std::size_t changed : {0, 1, 2, 3}) {
      cases.push_back(cases.back());
      auto& free = cases.back().conditions.free;
      if (changed < free.size()) free[changed] = !free[changed];
    }
    cases.push_back(someCase(condensed, 1));
    std::vector<bool> solvable;  // without any other set
    for (const auto& one : cases) {
      Condensed single(options);
      solvable.push_back(single.solver.solve(one).found);
    }
    EXPECT_GE(std::ranges::count(solvable, true), 3);
    for (const bool together : {false, true}) {
      Condensed fresh(options);
      std::vector<ContactSolution> found;
      if (together) found = fresh.solver.solve(cases);
      for (std::size_t i = 0; i < cases.size(); ++i) {
        if (!together) found.push_back(fresh.solver.solve(cases[i]));
        EXPECT_EQ(found[i].found, solvable[i]) << "set " << i;
        if (solvable[i]) expectEquations(fresh, cases[i], found[i]);
      }
    }
  }
}

// Without friction, closed contact has no causes, and the given forces are the effects.
TEST(ContactSolver, ClosedContactWithoutFrictionNeedsNothing) {
  Condensed condensed(pressedBlock);
  ContactCase one = someCase(condensed, 0);
  std::ranges::fill(one.conditions.coefficient, 0);
  std::ranges::fill(one.conditions.free, 0);
  const auto found = condensed.solver.solve(one);
  EXPECT_TRUE(found.found);
  EXPECT_EQ(found.effects, one.given);
  EXPECT_EQ(found.causes, ContactVector(found.effects.size(), 0.0));
}

// The same conditions make the solution linear in the forces.
TEST(ContactSolver, SolutionsSuperpose) {
  Condensed condensed(stickingPad);
  ContactCase first = someCase(condensed, 0), second = someCase(condensed, 1);
  second.conditions = first.conditions;
  ContactCase sum = first;
  for (std::size_t i = 0; i < sum.given.size(); ++i) sum.given[i] += 2 * second.given[i];
  const auto a = condensed.solver.solve(first), b = condensed.solver.solve(second),
             both = condensed.solver.solve(sum);
  double size = 0, error = 0;
  for (std::size_t i = 0; i < both.effects.size(); ++i) {
    size = worse(size, std::abs(both.effects[i]));
    error = worse(error, std::abs(both.effects[i] - a.effects[i] - 2 * b.effects[i]));
  }
  EXPECT_LE(largest(error), tolerance * largest(size));
}

TEST(ContactSolver, TakesGivenGaps) {
  Condensed condensed(stickingPad);
  const std::size_t nodes = condensed.impedance.nodes();
  std::vector<double> gaps;
  for (std::size_t i = 0; i < nodes; ++i) gaps.push_back(1e-6 * (i % 2));
  const ContactCase one = someCase(condensed, 2);
  const auto found = condensed.solver.withGaps(gaps, one);
  for (std::size_t i = 0; i < nodes; ++i) EXPECT_EQ(found.causes[nodes + i], gaps[i]);
  expectEquations(condensed, one, found, true);
}

// The force of a unit gap, once that gap has been open.
TEST(ContactSolver, StiffnessOfAGap) {
  Condensed condensed(pressedBlock);
  const std::size_t nodes = condensed.impedance.nodes();
  for (std::size_t i = 0; i < nodes; ++i) EXPECT_EQ(condensed.solver.stiffness(i), 0);
  ContactCase one = someCase(condensed, 0);
  std::ranges::fill(one.conditions.free, 1);
  condensed.solver.solve(one);
  for (int rank = 0; rank < mpi::size(PETSC_COMM_WORLD); ++rank) {
    std::size_t count = nodes;
    mpi::broadcast(PETSC_COMM_WORLD, count, rank);
    const bool isOwn = rank == mpi::rank(PETSC_COMM_WORLD);
    for (std::size_t i = 0; i < count; ++i) {
      ContactVector unit(condensed.impedance.length(), 0.0);
      if (isOwn) unit[nodes + i] = 1;
      const auto answer = responses(condensed, unit);
      if (!isOwn) continue;
      EXPECT_GT(answer[nodes + i], 0);
      // The columns are solved in blocks: the same to round-off.
      EXPECT_NEAR(condensed.solver.stiffness(i) / answer[nodes + i], 1, 1e-11);
    }
  }
}

}  // namespace
}  // namespace squeal::test
