#pragma once
/// These functions find the forces at the interfaces of a steady state, and their sums.
#include <vector>

#include "contact/contact.hpp"
#include "steady/steady.hpp"

namespace squeal::steady {

/// Collective. Returns the forces on the pads at the contact nodes, [contact node], N: normal and
/// friction forces by the law, and what holds the nodes that stick, from the nodal forces of the
/// bodies, N entries, with those of images added to those of their primaries.
std::vector<Point> forcesOnPads(const contact::Contact& contact, const Solution& solution,
                                Vec nodalForces);

/// Collective. Sets the tangential forces of the nodes that stick, in the basis of the gaps.
void setStickingForces(const contact::Contact& contact, Vec nodalForces, Solution& solution);

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
