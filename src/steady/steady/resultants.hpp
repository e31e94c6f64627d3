// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The forces at the interfaces of a steady state, and their sums.
#include <vector>

#include "model/contact/contact.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Returns the tangential forces on the pads at the contact nodes, [contact node], N:
/// friction by the law, and what holds the nodes that stick. That is what the nodal forces r, N
/// entries, N, and friction leave of equilibrium along the surface, in the rows of A that no
/// unknown of T has. `slip` includes that of released nodes.
std::vector<Point> tangentialForces(const contact::Contact& contact, const Solution& solution,
                                    const std::vector<contact::Slip>& slip, Vec nodalForces);

/// Collective. Sets the forces of the nodes that stick from these, in the basis of the gaps.
void setStickingForces(const contact::Contact& contact, const std::vector<Point>& tangential,
                       Solution& solution);

/// Collective. Returns the forces on the pads at the contact nodes, [contact node], N: the normal
/// forces of the solution and the tangential ones given.
std::vector<Point> forcesOnPads(const contact::Contact& contact, const Solution& solution,
                                std::vector<Point> tangential);

/// Collective. Returns the resultants of an interface. The forces on the nodes of the slave act on
/// the master through J, which spreads them, and on nodes of the slave that carry no condition: the
/// sums over the master are what is transmitted.
Resultant resultantOf(const contact::Contact& contact, int interface, const Solution& solution,
                      const std::vector<Point>& onPads);

/// Collective. Adds the forces of ties to `contactForces`, N entries: on the slaves those that keep
/// them in equilibrium with the nodal forces of the bodies, and on the masters their opposites. The
/// slaves of the highest level come first, as no other one rests on them.
void addTieForces(const contact::Contact& contact, Vec nodalForces, Vec contactForces);

}  // namespace squeal::steady
