// SPDX-License-Identifier: BSD-2-Clause
// The responses of the contact from the Schur complement, against those by solves.
#include "steady/impedance/impedance.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/petsc/log_events.hpp"
#include "support/algebra/dense.hpp"
#include "support/harness/largest_error.hpp"
#include "support/steady/condensed_contact.hpp"

namespace squeal::test {
namespace {

/// The pads with nodes that stick, whose tangential displacements are unknowns of the contact too.
const std::string stickingPad =
    floatingPad + " -contact_other_role sticking -contact_other_friction 0.4";

/// Collective. Returns T with all contact open and no sticking node held.
contact::Transformation openTransformation(const contact::Contact& contact) {
  const std::size_t nodes = contact.interfaces.nodes.size();
  return contact.transformation({contact::Mask(nodes, 0), contact::Mask(nodes, 1)});
}

// Both come from factorisations of one stiffness, whose condition number, some 1e4, leaves 1e-12.
// The check of the complement uses the factorised K0, so the complement is the only factorisation.
TEST(Impedance, TakesResponsesFromTheSchurComplement) {
  for (const auto& options : {floatingPad, stickingPad}) {
    const Condensed model(options);
    const auto& contact = model.model.contact;
    const auto open = openTransformation(contact);
    impedance::Impedance impedance(contact, open, model.model.bodies.stiffness,
                                   contact.slipRows(open, model.unitSlip(), model.allClosed(), 0),
                                   model.closed);
    const PetscInt count = mpi::sum(PETSC_COMM_WORLD, PetscInt(impedance.nodeOf().size()));
    EXPECT_EQ(count > impedance.size(), options == stickingPad);
    std::vector<PetscInt> all(count);
    for (PetscInt i = 0; i < count; ++i) all[i] = count - 1 - i;
    const auto solved = impedance.responsesToUnits(all);
    EXPECT_FALSE(impedance.isCondensed());
    const long before = impedance.solves();
    const auto factorisations = sparseWork().factorisations;
    impedance.condenseAfter(1);
    const auto picked = impedance.responsesToUnits(all);
    EXPECT_TRUE(impedance.isCondensed());
    EXPECT_EQ(impedance.solves() - before, 8);  // of the check
    EXPECT_EQ(sparseWork().factorisations - factorisations, 1);
    const double size = largest(largestEntry(solved)),
                 difference = largest(largestDifference(picked, solved));
    print("%zu responses: %.1e of the largest\n", all.size(), difference / size);
    EXPECT_LE(difference, 1e-12 * size);
  }
}

}  // namespace
}  // namespace squeal::test
