// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/steady_sweep.hpp"

#include <algorithm>

#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "run/analysis/condensed_sweep.hpp"
#include "run/analysis/state_log.hpp"
#include "run/analysis/steady_messages.hpp"

namespace squeal::analysis {
namespace {

/// Collective. Solves in all unknowns, with the system of one active set after the other.
void fullSweep(const SteadyInput& input, StateLog& log, CurrentSystem& system,
               SteadyStates& states) {
  const auto& [model, sweep, settings] = input;
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  std::vector<contact::ActiveSet> active;  // [steady point] of its solution, or the one tried
  for (const auto& at : sweep.steadyPoints()) {
    const std::size_t k = active.size();
    const auto neighbour = sweep.earlierNeighbour(k);
    active.push_back(neighbour ? active[*neighbour] : model.bonded());
    if (k < states.solutions.size()) {  // restored from the checkpoint
      if (states.solutions[k].converged) active.back() = steady::activeSet(states.solutions[k]);
      continue;
    }
    stopIfRequested(model.mesh->comm);
    const auto& current = system.of(active.back());
    current.solver();
    Stage stage(model.mesh->comm, "steady");
    const auto& solution = states.solutions.emplace_back(problem.solve(at, current));
    stage.finish(resultText(solution, model.contact));
    reportState(solution, model);
    if (solution.converged) active.back() = steady::activeSet(solution);
    log.write();
  }
}

}  // namespace

const steady::Solution& SteadyStates::at(sweep::Parameters point) const {
  point.damping = 1;
  return *std::ranges::find_if(solutions, [&](const auto& one) { return one.at == point; });
}

SteadyStates steadyStates(const SteadyInput& input, checkpoint::Checkpoint& checkpoint,
                          CurrentSystem& system) {
  const MPI_Comm comm = input.model.mesh->comm;
  SteadyStates states;
  states.complete = completed([&] {
    stopIfRequested(comm);
    StateLog log(comm, checkpoint, states);
    if (input.settings.full)
      fullSweep(input, log, system, states);
    else
      CondensedSweep(input, system, states).solve(log);
    log.finish();
  });
  return states;
}

}  // namespace squeal::analysis
