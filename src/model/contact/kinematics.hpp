#pragma once
/// This function builds the kinematics u = A z of contact, with a normal and tangents at each
/// contact node.
#include <vector>

#include "model/contact/contact.hpp"

namespace squeal::contact {

/// Returns the number of blocks in each row of blocks of a matrix that connects the slaves of this
/// level with themselves and their masters, [owned node], at least one. The level 0 stands for the
/// contact nodes of all levels.
std::vector<PetscInt> blocksOfRows(const Contact& contact, int level);

/// Collective. Returns A as it is before periodicity and with gaps at the nodes, marks the free
/// components of z in Contact::free and sets the values of the others in `held`. Throws Error on
/// all ranks for a held component that is not tangential at a contact node, and for any at a node
/// that sticks.
OwnedMat buildKinematics(Contact& contact, Vec held);

}  // namespace squeal::contact
