// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/steady_sweep.hpp"

#include <algorithm>

#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "run/analysis/condensed_sweep.hpp"
#include "run/analysis/state_log.hpp"
#include "run/analysis/steady_messages.hpp"

namespace squeal::analysis {
namespace {

/// Collective. Solves in all unknowns, with the system of one active set after the other.
void fullSweep(const SteadyInput& input, StateLog& log, CurrentSystem& system,
               SteadyStates& states) {
  const auto& [model, sweep, settings, fromZero] = input;
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
  if (!fromZero) return;
  for (std::size_t k = 0; k < active.size(); ++k) {
    std::string& why = states.whyNotFromZero.emplace_back();
    const auto& first = states.solutions[k];
    if (!beginsLine(states.solutions, k)) continue;
    stopIfRequested(model.mesh->comm);
    const auto without =
        problem.solve({0, first.at.speed, first.at.pressure}, system.of(active[k]));
    why = whyNotFollowed(
        without, contact::countDifferent(model.mesh->comm, steady::activeSet(without), active[k]));
  }
}

}  // namespace

bool beginsLine(const std::vector<steady::Solution>& solutions, std::size_t point) {
  if (!solutions[point].converged || solutions[point].at.friction == 0) return false;
  for (; point > 0 && sweep::growsInFriction(solutions[point - 1].at, solutions[point].at); --point)
    if (solutions[point - 1].converged) return false;
  return true;
}

std::string whyNotFollowed(const steady::Solution& without, PetscInt changes) {
  if (!without.converged) return "no steady state was found without friction";
  if (changes == 0) return "";
  return formatted("%" PetscInt_FMT
                   " %s of contact below the first friction of the sweep; begin the sweep at "
                   "friction 0",
                   changes, changes == 1 ? "change" : "changes");
}

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
