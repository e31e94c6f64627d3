// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The forces at the interfaces of a steady state, and their sums.
#include <vector>

#include "model/contact/contact.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Returns the tangential forces on the pads at the contact nodes, [contact node], N:
/// friction by the law, and the reactions on sticking nodes. In the tangential rows of Aᵀ without
/// an unknown in T, the reactions balance the nodal forces r (`nodalForces`, N entries, in newtons)
/// and the friction. `slip` includes the slip of released nodes.
std::vector<Point> tangentialForces(const contact::Contact& contact, const Solution& solution,
                                    const std::vector<contact::Slip>& slip, Vec nodalForces);

/// Collective. Sets the tangential forces of sticking nodes from `tangential`, converted to the
/// basis of the gaps.
void setStickingForces(const contact::Contact& contact, const std::vector<Point>& tangential,
                       Solution& solution);

/// Collective. Returns the forces on the pads at the contact nodes, [contact node], N: the normal
/// forces of the solution plus `tangential`.
std::vector<Point> forcesOnPads(const contact::Contact& contact, const Solution& solution,
                                std::vector<Point> tangential);

/// Collective. Returns the resultants of an interface. Jᵀ distributes the forces on slave nodes
/// over the master and over slave nodes without a condition. The resultants are the sums over the
/// side of the pad.
Resultant resultantOf(const contact::Contact& contact, int interface, const Solution& solution,
                      const std::vector<Point>& onPads);

/// Collective. Returns `contactForces`, N entries, with the forces of ties and couplings added: the
/// slaves get the forces that balance the nodal forces of the bodies, and the masters get the
/// opposite forces. The slaves of the highest level are treated first, since no other slave depends
/// on them.
OwnedVec withTieForces(const contact::Contact& contact, Vec nodalForces, OwnedVec contactForces);

}  // namespace squeal::steady
