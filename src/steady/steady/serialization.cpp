// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/serialization.hpp"

namespace squeal::steady {

/// The streams find both by argument-dependent lookup.
void fields(Stream& stream, Resultant& resultant);
void fields(Stream& stream, Sticking& sticking);

// These list all members: a new one does not compile until it is added here.

void fields(Stream& stream, Resultant& resultant) {
  auto& [interface, normalForce, frictionForce, moment, leastFriction, worst, stickingLimit,
         overLimit, pulled, released, returned, unheld, momentDefect] = resultant;
  stream(interface, normalForce, frictionForce, moment, leastFriction, worst, stickingLimit,
         overLimit, pulled, released, returned, unheld, momentDefect);
}

void fields(Stream& stream, Sticking& sticking) {
  auto& [holds, direction, heldAgain, slidBack] = sticking;
  stream(holds, direction, heldAgain, slidBack);
}

void serialise(checkpoint::Archive& archive, Solution& solution) {
  auto& [at, converged, reason, existsTo, tolerance, iterations, residual, displacement, contact,
         slip, closed, sticking, revisions, negligibleForce, openNodes, smallestPressure,
         resultants, imbalance, nodesOfAnother] = solution;
  archive.common(at, converged, reason, existsTo, tolerance, iterations, residual, revisions,
                 negligibleForce, openNodes, smallestPressure, resultants, imbalance,
                 nodesOfAnother);
  archive.own(contact, slip, closed, sticking);
  archive.vector(displacement);
}

}  // namespace squeal::steady
