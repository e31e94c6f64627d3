#include "steady/kept.hpp"

namespace squeal::steady {

/// The streams find these two by their arguments.
void fields(checkpoint::Stream& stream, Resultant& resultant);
void fields(checkpoint::Stream& stream, Sticking& sticking);

void fields(checkpoint::Stream& stream, Resultant& resultant) {
  stream(resultant.interface, resultant.normalForce, resultant.frictionForce, resultant.moment,
         resultant.leastFriction, resultant.worst, resultant.stickingLimit, resultant.overLimit,
         resultant.released, resultant.unheld, resultant.momentDefect);
}

void fields(checkpoint::Stream& stream, Sticking& sticking) {
  stream(sticking.holds, sticking.direction, sticking.heldAgain);
}

void exchange(checkpoint::Archive& archive, Solution& solution) {
  archive.common(solution.at, solution.converged, solution.reason, solution.existsTo,
                 solution.tolerance, solution.iterations, solution.residual, solution.revisions,
                 solution.negligibleForce, solution.openNodes, solution.smallestPressure,
                 solution.resultants, solution.imbalance);
  archive.own(solution.contact, solution.slip, solution.closed, solution.sticking);
  archive.vector(solution.displacement);
}

}  // namespace squeal::steady
