// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/steady_messages.hpp"

#include "base/petsc/finite.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"
#include "run/analysis/tightening.hpp"

namespace squeal::analysis {
namespace {

std::string stickText(PetscInt nodes) {
  return formatted("%" PetscInt_FMT " %s", nodes, nodes == 1 ? "node sticks" : "nodes stick");
}

/// Not collective. Reports sticking interfaces on which nodes slide, or exceed the limit of
/// friction.
void reportSticking(const steady::Solution& solution, MPI_Comm comm) {
  for (const auto& resultant : solution.resultants) {
    const std::string head =
        sweep::parameterText(solution.at) + ": interface '" + resultant.interface + "': ";
    if (resultant.released + resultant.unheld > 0)
      printLine(comm, head + formatted("after %d revisions of the active set, %" PetscInt_FMT
                                       " nodes slide, and %" PetscInt_FMT
                                       " without a consistent state (they open if held and close "
                                       "if free) are left free",
                                       solution.revisions, resultant.released, resultant.unheld));
    if (resultant.returned > 0)
      printWarning(comm, head + formatted("%" PetscInt_FMT
                                          " nodes that slide have no consistent state: held, they "
                                          "exceed their limit of friction; released, they slide "
                                          "back; they keep their friction",
                                          resultant.returned));
    if (const PetscInt pressed = resultant.overLimit - resultant.pulled; pressed > 0)
      printWarning(
          comm, head + formatted("%s beyond its coefficient of friction and %s up to %.4g, "
                                 "at %s; the tables of the steady state list them, and "
                                 "-contact_%s_release on lets them slide",
                                 stickText(pressed).c_str(), pressed == 1 ? "needs" : "need",
                                 resultant.leastFriction, interfaces::text(resultant.worst).c_str(),
                                 resultant.interface.c_str()));
    if (resultant.pulled > 0)
      printWarning(comm, head + stickText(resultant.pulled) +
                             " under tension with a tangential force, for which no coefficient of "
                             "friction suffices; the tables of the steady state list them. Leave "
                             "-contact_" +
                             resultant.interface + "_friction out if the interface is bonded");
  }
}

}  // namespace

std::string resultText(const steady::Solution& solution, const contact::Contact& contact) {
  return formatted("%s: %s after %d iterations, %" PetscInt_FMT " of %" PetscInt_FMT
                   " nodes open, smallest pressure %.4g, residual %.0e, imbalance %.0e",
                   sweep::parameterText(solution.at).c_str(), solution.reason.c_str(),
                   solution.iterations, solution.openNodes, contact.interfaces.totalNodes,
                   solution.smallestPressure, solution.residual, solution.imbalance);
}

void reportState(const steady::Solution& solution, const Model& model) {
  const std::string at = sweep::parameterText(solution.at);
  if (solution.converged) {
    requireFinite(solution.displacement, "steady sliding at " + at);
    reportSticking(solution, model.mesh->comm);
    const auto bolts = boltForces(model, solution);
    for (std::size_t i = 0; i < bolts.size(); ++i)
      printLine(model.mesh->comm, at + formatted(": bolt '%s': tension %.6g N",
                                                 model.mesh->sections[i].name.c_str(), bolts[i]));
  } else {
    printWarning(model.mesh->comm,
                 "no steady sliding solution found at " + at + ": " + solution.reason);
  }
}

}  // namespace squeal::analysis
