#pragma once
/// This function builds the kinematics u = A z of contact, with a normal and tangents at each
/// contact node.
#include <vector>

#include "contact/contact.hpp"
#include "contact/interfaces.hpp"
#include "contact/nodes.hpp"

namespace squeal::contact {

/// Collective. Returns A as it is before periodicity and with gaps at the nodes, marks the free
/// components of z in Contact::free and sets the values of the others in `held`. The connections
/// are those of the contact nodes. Throws Error on all ranks for a held component that is not
/// tangential at a contact node.
OwnedMat buildKinematics(const std::vector<InterfaceOptions>& interfaces,
                         const std::vector<Connection>& connections, Contact& contact, Vec held);

}  // namespace squeal::contact
