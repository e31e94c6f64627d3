// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/condensed_sweep.hpp"

#include <algorithm>

#include "base/session/stages.hpp"
#include "base/system/mpi.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "run/analysis/steady_messages.hpp"
#include "steady/steady/limit_states.hpp"

namespace squeal::analysis {
namespace {

/// The largest number of steady points that are solved together.
constexpr std::size_t largestBatch = 16;

std::string endText(const condensed::ContactPath& path) {
  constexpr int digits = 9;  // digits that identify an event; the path locates it more accurately
  return sweep::parameterText(path.end, digits) + ": " + path.obstacle;
}

}  // namespace

CondensedSweep::CondensedSweep(const SteadyInput& input, CurrentSystem& current,
                               SteadyStates& states)
    : input_(input),
      comm_(input.model.mesh->comm),
      problem_(*input.model.mesh, input.model.bodies, input.model.contact),
      closed_(current.of(input.model.bonded())),
      isExact_(condensed::CondensedProblem::isExact(input.model.contact, input.model.bodies)),
      states_(states) {}

void CondensedSweep::solve(StateLog& log) {
  const auto points = input_.sweep.steadyPoints();
  std::vector<steady::Solution>& solutions = states_.solutions;
  if (solutions.size() < points.size()) closed_.solver();
  while (solutions.size() < points.size()) {
    stopIfRequested(comm_);
    const std::size_t begin = solutions.size(), end = std::min(begin + largestBatch, points.size());
    solveBatch({points.begin() + begin, points.begin() + end});
    if (isExact_) {
      for (const Step& step : stepsToFollow(begin)) followPath(step);
      continueFromLast();
    }
    log.write();
  }
  if (input_.fromZero) examineBelow();
}

/// Collective. Examines the contact between friction 0 and the first point of each line.
void CondensedSweep::examineBelow() {
  for (std::size_t k = 0; k < states_.solutions.size(); ++k)
    states_.whyNotFromZero.push_back(
        beginsLine(states_.solutions, k) ? whyNotFromZero(states_.solutions[k]) : "");
}

std::string CondensedSweep::whyNotFromZero(const steady::Solution& first) {
  stopIfRequested(comm_);
  if (!condensed_) condensed_.emplace(problem_, closed_);
  condensed_->continueFrom(first);  // whether or not the run was resumed
  const sweep::Parameters zero{0, first.at.speed, first.at.pressure};
  auto without = condensed_->solve(zero);
  if (!without.converged) without = condensed_->solveWithPivots(zero);
  PetscInt changes =
      contact::countDifferent(comm_, steady::activeSet(without), steady::activeSet(first));
  // Nodes may change twice.
  if (without.converged && changes == 0 && isExact_ && input_.settings.path > 0) {
    const auto path = condensed::traceContact(*condensed_, without, first.at);
    if (!path.obstacle.empty())
      return "the contact was followed from friction 0 only up to " + endText(path);
    changes = path.count;
  }
  return whyNotFollowed(without, changes);
}

/// Collective. Adds the states at the next points.
void CondensedSweep::solveBatch(const std::vector<sweep::Parameters>& points) {
  std::vector<steady::Solution>& solutions = states_.solutions;
  Stage stage(comm_, "steady");
  if (!condensed_) {
    condensed_.emplace(problem_, closed_);
    continueFromLast();
  }
  const long before = condensed_->solves();
  const std::size_t begin = solutions.size();
  for (auto& solution : condensed_->solveTogether(points)) solutions.push_back(std::move(solution));
  for (std::size_t k = begin; k < solutions.size(); ++k) {
    solveAgain(k);
    stage.printLine(resultText(solutions[k], input_.model.contact));
    reportState(solutions[k], input_.model);
  }
  stage.finish(
      formatted("%zu points, %ld right-hand sides", points.size(), condensed_->solves() - before));
}

/// Makes the next points start from the last solution.
void CondensedSweep::continueFromLast() {
  const auto& solutions = states_.solutions;
  const auto last = std::ranges::find_if(solutions.rbegin(), solutions.rend(),
                                         [](const auto& one) { return one.converged; });
  if (last != solutions.rend()) condensed_->continueFrom(*last);
}

/// Collective. Tries other ways to solve for a point without a solution.
void CondensedSweep::solveAgain(std::size_t point) {
  const bool& converged = states_.solutions[point].converged;
  if (!converged && isExact_) continueFromNeighbour(point);
  if (!converged && !isExact_) solveFromNearest(point);
  if (!converged) solveWithPivots(point);
  if (!converged && !isExact_) solveInAllUnknowns(point);
}

/// Collective. Follows the contact from the state at another point to one where no solution has
/// been found, and solves again from the end of the path; if the path ends before, says where and
/// why.
void CondensedSweep::continueTo(const steady::Solution& from, steady::Solution& solution) {
  auto path = condensed::traceContact(*condensed_, from, solution.at);
  const std::string way = "followed from " + sweep::parameterText(from.at);
  if (!path.obstacle.empty()) {
    solution.existsTo = path.end;
    solution.reason += "; " + way + " up to " + endText(path);
    return;
  }
  const std::string before = solution.reason;
  condensed_->startFrom(std::move(path.gaps), std::move(path.sticking));
  solution = condensed_->solve(solution.at);
  if (solution.converged)
    solution.reason += ", " + way + " after " + before;
  else if (solution.reason != before)
    solution.reason += "; " + before;
}

/// Collective. Continues to a point without a solution from a neighbour, or from friction 0 if no
/// neighbour has a solution.
void CondensedSweep::continueFromNeighbour(std::size_t point) {
  auto& solutions = states_.solutions;
  auto known = input_.sweep.earlierNeighbour(point);
  while (known && !solutions[*known].converged) known = input_.sweep.earlierNeighbour(*known);
  if (known) return continueTo(solutions[*known], solutions[point]);
  const sweep::Parameters at = solutions[point].at;
  if (at.friction == 0) return;
  if (const auto without = condensed_->solveWithPivots({0, at.speed, at.pressure});
      without.converged)
    continueTo(without, solutions[point]);
}

/// Collective. Solves again for a point without a solution, from the states at the nearest points
/// before and after it that have one.
void CondensedSweep::solveFromNearest(std::size_t point) {
  auto& all = states_.solutions;
  const auto before = std::find_if(all.rbegin() + (all.size() - point), all.rend(),
                                   [](const auto& one) { return one.converged; });
  const auto after =
      std::find_if(all.begin() + point, all.end(), [](const auto& one) { return one.converged; });
  std::vector<const steady::Solution*> starts;
  if (before != all.rend()) starts.push_back(&*before);
  if (after != all.end()) starts.push_back(&*after);
  for (const auto* start : starts) {
    condensed_->continueFrom(*start);
    auto again = condensed_->solve(all[point].at);
    if (!again.converged) continue;
    again.reason +=
        ", from the state at " + sweep::parameterText(start->at) + ", after " + all[point].reason;
    all[point] = std::move(again);
    return;
  }
}

/// Collective. Solves again for a point without a solution, with complementary pivots.
void CondensedSweep::solveWithPivots(std::size_t point) {
  steady::Solution& solution = states_.solutions[point];
  auto again = condensed_->solveWithPivots(solution.at);
  if (!again.converged) return;
  again.reason += " with complementary pivots (without: " + solution.reason + ")";
  solution = std::move(again);
}

/// Collective. Solves again for a point without a solution, in all unknowns.
void CondensedSweep::solveInAllUnknowns(std::size_t point) {
  steady::Solution& solution = states_.solutions[point];
  const std::string condensedReason = solution.reason;
  solution = problem_.solve(solution.at, closed_);
  solution.reason += ", in all unknowns";
  if (!solution.converged) solution.reason += "; in those of the contact: " + condensedReason;
}

std::string CondensedSweep::stepText(const Step& step) const {
  return "contact between " + sweep::parameterText(states_.solutions[step.from].at) + " and " +
         sweep::parameterText(states_.solutions[step.to].at) + ": ";
}

/// Collective. Returns the steps to the points from `begin` on that are short enough to be
/// followed, and reports the others.
std::vector<CondensedSweep::Step> CondensedSweep::stepsToFollow(std::size_t begin) const {
  const int limit = input_.settings.path;
  const auto& solutions = states_.solutions;
  std::vector<Step> steps;
  for (std::size_t k = begin; k < solutions.size() && limit > 0; ++k) {
    const auto neighbour = input_.sweep.earlierNeighbour(k);
    if (!neighbour) continue;
    const auto &from = solutions[*neighbour], &to = solutions[k];
    if (!from.converged || !to.converged) continue;
    if (const PetscInt changes = contact::countDifferent(comm_, from.closed, to.closed);
        changes <= limit)
      steps.push_back({*neighbour, k});
    else
      printLine(comm_, stepText({*neighbour, k}) +
                           formatted("%" PetscInt_FMT " nodes change; -steady_path %" PetscInt_FMT
                                     " locates the changes",
                                     changes, changes));
  }
  return steps;
}

/// Collective. Adds the events between the states at neighbouring points. If there are several
/// solutions, the one that the path leads to becomes that of its end.
void CondensedSweep::followPath(const Step& step) {
  Stage stage(comm_, "steady");
  const long before = condensed_->solves();
  auto path = condensed::traceContact(*condensed_, states_.solutions[step.from],
                                      states_.solutions[step.to].at);
  if (!path.obstacle.empty())
    printWarning(comm_, stepText(step) + "followed up to " + endText(path));
  const int count = path.count;
  addEvents(std::move(path.events), count, step);
  if (path.obstacle.empty()) takeSolutionOfPath(path, step);
  if (count > 0)
    stage.finish(stepText(step) + formatted("%d %s, %ld right-hand sides", count,
                                            count == 1 ? "node changes" : "nodes change",
                                            condensed_->solves() - before));
}

/// Adds the events of this rank on a step, `count` on all ranks.
void CondensedSweep::addEvents(std::vector<condensed::ContactEvent> events, int count,
                               const Step& step) {
  for (auto& event : events) {
    event.order += states_.events;
    event.point = step.to;
    states_.path.push_back(event);
  }
  states_.events += count;
}

/// Collective. Replaces the solution at the end of a step by the one that the path leads to, if
/// other nodes are open there. If nodes open or close exactly at the end, or if only the holds of
/// sticking nodes differ, the path ends with a change to the active set of the solution, which is
/// computed with as many nodes held as possible. Where nodes begin or cease to slide is not known.
void CondensedSweep::takeSolutionOfPath(condensed::ContactPath& path, const Step& step) {
  steady::Solution& solution = states_.solutions[step.to];
  const contact::ActiveSet end{path.closed, path.sticking.free()};
  const auto holds = path.sticking.holds;
  const PetscInt others = contact::countDifferent(comm_, path.closed, solution.closed);
  const auto isAtChange = [&] {
    return steady::isOnActiveSet(input_.model.contact, solution,
                                 {path.closed, steady::activeSet(solution).released});
  };
  if (others > 0 && !isAtChange()) {
    condensed_->startFrom(std::move(path.gaps), std::move(path.sticking));
    auto ahead = condensed_->solve(solution.at);
    if (!ahead.converged || contact::countDifferent(comm_, ahead.closed, path.closed) != 0) return;
    solution = std::move(ahead);
    solution.nodesOfAnother = others;
    printWarning(comm_, stepText(step) +
                            formatted("steady sliding is not unique at the end: another solution "
                                      "differs in %" PetscInt_FMT
                                      " %s; the run keeps the one that the path leads to",
                                      others, others == 1 ? "contact node" : "contact nodes"));
  }
  auto changes = condensed::changesBetween(end, steady::activeSet(solution), path.end, 0);
  const auto slides = [](steady::Hold hold) { return hold == steady::Hold::released; };
  std::erase_if(changes, [&](const auto& change) {
    return slides(holds[change.node]) || slides(solution.sticking.holds[change.node]);
  });
  const int count = mpi::sum(comm_, static_cast<int>(changes.size()));
  addEvents(std::move(changes), count, step);
}

}  // namespace squeal::analysis
