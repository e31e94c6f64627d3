// SPDX-License-Identifier: BSD-2-Clause
// The responses of the contact from the Schur complement, against those by solves.
#include "steady/impedance/impedance.hpp"

#include <gtest/gtest.h>

#include "support/algebra/dense.hpp"
#include "support/harness/largest_error.hpp"
#include "support/steady/condensed_contact.hpp"

namespace squeal::test {
namespace {

// Both come from factorisations of one stiffness, whose condition number, some 1e4, leaves 1e-12.
TEST(Impedance, TakesResponsesFromTheSchurComplement) {
  Condensed condensed(floatingPad);
  const auto& impedance = condensed.impedance;
  std::vector<PetscInt> all(mpi::sum(PETSC_COMM_WORLD, PetscInt(impedance.nodeOf().size())));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = all.size() - 1 - i;
  const auto solved = impedance.responsesToUnits(all);
  EXPECT_FALSE(impedance.isCondensed());
  const long before = impedance.solves();
  condensed.impedance.condenseAfter(1);
  const auto picked = impedance.responsesToUnits(all);
  EXPECT_TRUE(impedance.isCondensed());
  EXPECT_EQ(impedance.solves() - before, 8);  // of the check
  const double size = largest(largestEntry(solved)),
               difference = largest(largestDifference(picked, solved));
  print("%zu responses: %.1e of the largest\n", all.size(), difference / size);
  EXPECT_LE(difference, 1e-12 * size);
}

}  // namespace
}  // namespace squeal::test
