// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/steady_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/options/options.hpp"
#include "base/petsc/finite.hpp"
#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/interfaces/settings.hpp"
#include "steady/condensed/condensed_problem.hpp"
#include "steady/condensed/contact_path.hpp"
#include "steady/steady/serialization.hpp"

namespace squeal::analysis {
namespace {

/// Collective. Tells which sticking interfaces are held by more than their limit of friction, and
/// which slide.
void reportSticking(const Analysis& analysis, const steady::Solution& solution) {
  for (const auto& resultant : solution.resultants) {
    const std::string head =
        sweep::parameterText(solution.at) + ": interface '" + resultant.interface + "': ";
    if (resultant.released + resultant.unheld > 0)
      printLine(
          analysis.mesh->comm,
          head +
              formatted("%" PetscInt_FMT " nodes slide and %" PetscInt_FMT
                        " touch without being held, as they open or slide when they are, after %d "
                        "revisions",
                        resultant.released, resultant.unheld, solution.revisions));
    if (resultant.overLimit > 0)
      printWarning(
          analysis.mesh->comm,
          head + formatted("%" PetscInt_FMT
                           " nodes are held although they exceed its coefficient of friction, "
                           "up to %.4g at %s; the tables of the steady state list them, and "
                           "-contact_%s_release on lets them slide",
                           resultant.overLimit, resultant.leastFriction,
                           interfaces::text(resultant.worst).c_str(), resultant.interface.c_str()));
  }
}

std::string endText(const condensed::ContactPath& path) {
  constexpr int digits = 9;  // it is solved for to 1e-8
  return sweep::parameterText(path.end, digits) + ": " + path.obstacle;
}

/// Collective. Follows the contact from the state at another point to one where no solution has
/// been found, and tries again from where that leads; if it does not lead there, says why and where
/// it ends.
void continueTo(condensed::CondensedProblem& condensed, const steady::Solution& from,
                steady::Solution& solution) {
  auto path = condensed::traceContact(condensed, from, solution.at);
  const std::string way = "followed from " + sweep::parameterText(from.at);
  if (!path.obstacle.empty()) {
    solution.existsTo = path.end;
    solution.reason += "; " + way + " up to " + endText(path);
    return;
  }
  const std::string before = solution.reason;
  condensed.startFrom(std::move(path.gaps), std::move(path.sticking));
  solution = condensed.solve(solution.at);
  if (solution.converged)
    solution.reason += ", " + way + " after " + before;
  else if (solution.reason != before)
    solution.reason += "; " + before;
}

/// Collective. Continues to a point without a solution from its neighbours, or from friction 0
/// where none of them has one.
void continueFromNeighbour(Analysis& analysis, condensed::CondensedProblem& condensed,
                           std::size_t point) {
  auto& solution = analysis.steady[point];
  auto known = analysis.sweep.earlierNeighbour(point);
  while (known && !analysis.steady[*known].converged)
    known = analysis.sweep.earlierNeighbour(*known);
  if (known) return continueTo(condensed, analysis.steady[*known], solution);
  const auto& at = solution.at;
  if (at.friction == 0) return;
  if (const auto without = condensed.solveWithPivots({0, at.speed, at.pressure}); without.converged)
    continueTo(condensed, without, solution);
}

/// Collective. Solves again for a point without a solution, from the states at the nearest points
/// before and behind it that have one.
void solveFromBeside(Analysis& analysis, condensed::CondensedProblem& condensed,
                     std::size_t point) {
  auto& all = analysis.steady;
  const auto before = std::find_if(all.rbegin() + (all.size() - point), all.rend(),
                                   [](const auto& one) { return one.converged; });
  const auto behind =
      std::find_if(all.begin() + point, all.end(), [](const auto& one) { return one.converged; });
  std::vector<const steady::Solution*> starts;
  if (before != all.rend()) starts.push_back(&*before);
  if (behind != all.end()) starts.push_back(&*behind);
  for (const auto* start : starts) {
    condensed.continueFrom(*start);
    auto again = condensed.solve(all[point].at);
    if (!again.converged) continue;
    again.reason +=
        ", from the state at " + sweep::parameterText(start->at) + ", after " + all[point].reason;
    all[point] = std::move(again);
    return;
  }
}

/// Collective. Solves again for a point without a solution, with complementary pivots.
void solveWithPivots(condensed::CondensedProblem& condensed, steady::Solution& solution) {
  auto again = condensed.solveWithPivots(solution.at);
  if (!again.converged) return;
  again.reason += " with complementary pivots (without: " + solution.reason + ")";
  solution = std::move(again);
}

/// The way to a steady point from its neighbour, by their numbers.
struct Way {
  std::size_t from, to;
};

std::string betweenText(const Analysis& analysis, const Way& way) {
  return "contact between " + sweep::parameterText(analysis.steady[way.from].at) + " and " +
         sweep::parameterText(analysis.steady[way.to].at) + ": ";
}

/// Collective. Returns the ways to be followed: those to the points from `begin` on, from their
/// neighbours. Reports the ways that are too long.
std::vector<Way> waysToFollow(const Analysis& analysis, std::size_t begin) {
  const MPI_Comm comm = analysis.mesh->comm;
  const int limit = analysis.settings.mesh->steady.path;
  std::vector<Way> ways;
  for (std::size_t k = begin; k < analysis.steady.size() && limit > 0; ++k) {
    const auto neighbour = analysis.sweep.earlierNeighbour(k);
    if (!neighbour) continue;
    const auto &from = analysis.steady[*neighbour], &to = analysis.steady[k];
    if (!from.converged || !to.converged) continue;
    if (const PetscInt changes = contact::countDifferent(comm, from.closed, to.closed);
        changes <= limit)
      ways.push_back({*neighbour, k});
    else
      printLine(comm, betweenText(analysis, {*neighbour, k}) +
                          formatted("%" PetscInt_FMT " nodes change; -steady_path %" PetscInt_FMT
                                    " finds where",
                                    changes, changes));
  }
  return ways;
}

/// Collective. Prepares followPath() on all these ways.
void anticipate(const Analysis& analysis, condensed::CondensedProblem& condensed,
                const std::vector<Way>& ways) {
  Stage stage(analysis.mesh->comm, "steady");
  const long before = condensed.solves();
  std::vector<condensed::ContactInterval> ends;
  for (const Way& way : ways)
    ends.push_back({&analysis.steady[way.from], &analysis.steady[way.to]});
  condensed::precomputeContact(condensed, ends);
  if (const long more = condensed.solves() - before; more > 0)
    stage.finish(formatted("contact between the points: %ld right-hand sides", more));
}

/// Collective. Adds the events on the way between the states at neighbouring points. Where there
/// are several solutions, the one to which the way leads becomes that of its end.
void followPath(Analysis& analysis, condensed::CondensedProblem& condensed, const Way& way) {
  const MPI_Comm comm = analysis.mesh->comm;
  const std::string between = betweenText(analysis, way);
  steady::Solution& solution = analysis.steady[way.to];
  Stage stage(comm, "steady");
  auto path = condensed::traceContact(condensed, analysis.steady[way.from], solution.at);
  if (!path.obstacle.empty()) printWarning(comm, between + "followed up to " + endText(path));
  for (auto& event : path.events) {
    event.order += analysis.contactEvents;
    analysis.contactPath.push_back(event);
  }
  analysis.contactEvents += path.count;
  const PetscInt others =
      path.obstacle.empty() ? contact::countDifferent(comm, path.closed, solution.closed) : 0;
  if (others > 0) {
    condensed.startFrom(std::move(path.gaps), std::move(path.sticking));
    auto ahead = condensed.solve(solution.at);
    if (ahead.converged && contact::countDifferent(comm, ahead.closed, path.closed) == 0) {
      solution = std::move(ahead);
      solution.nodesOfAnother = others;
      printWarning(
          comm, between + formatted("steady sliding is not unique at the end: in another solution "
                                    "%" PetscInt_FMT " %s; the one that the way leads to is kept",
                                    others,
                                    others == 1 ? "contact node differs" : "contact nodes differ"));
    }
  }
  if (path.count > 0)
    stage.finish(between +
                 formatted("%d %s", path.count,
                           path.count == 1 ? "node opens or closes" : "nodes open or close"));
}

}  // namespace

const contact::CoupledSystem& CurrentSystem::of(const contact::ActiveSet& active) {
  if (system_ && contact::sameOnAllRanks(analysis_.mesh->comm, system_->activeSet(), active))
    return *system_;
  system_.reset();  // the old factorisation's memory first
  Stage stage(analysis_.mesh->comm, "contact");
  system_ = std::make_unique<contact::CoupledSystem>(analysis_.bodies, analysis_.contact, active);
  const PetscInt nodes = analysis_.contact.interfaces.totalNodes;
  stage.finish(formatted("%" PetscInt_FMT " unknowns with %" PetscInt_FMT " of %" PetscInt_FMT
                         " contact nodes closed",
                         system_->size(), nodes - system_->openNodes(), nodes));
  return *system_;
}

namespace {

contact::ActiveSet bonded(const Analysis& analysis) {
  return contact::ActiveSet::bonded(analysis.contact.interfaces.nodes.size());
}

/// The largest number of steady points that are solved for together.
constexpr std::size_t mostTogether = 16;

/// Collective. Tells what the solution at a point is.
void tell(const Analysis& analysis, const steady::Solution& solution) {
  const std::string at = sweep::parameterText(solution.at);
  if (solution.converged) {
    requireFinite(solution.displacement, "steady sliding at " + at);
    reportSticking(analysis, solution);
  } else {
    printWarning(analysis.mesh->comm,
                 "no steady sliding solution found at " + at + ": " + solution.reason);
  }
}

std::string resultText(const Analysis& analysis, const steady::Solution& solution) {
  return formatted("%s: %s after %d iterations, %" PetscInt_FMT " of %" PetscInt_FMT
                   " nodes open, smallest pressure %.4g, residual %.0e, imbalance %.0e",
                   sweep::parameterText(solution.at).c_str(), solution.reason.c_str(),
                   solution.iterations, solution.openNodes, analysis.contact.interfaces.totalNodes,
                   solution.smallestPressure, solution.residual, solution.imbalance);
}

/// The steady states in the checkpoint: those of the analysis from `kept` on are not in it yet.
class KeptStates {
 public:
  /// Collective. Adds to the analysis what the checkpoint has.
  explicit KeptStates(Analysis& analysis) : analysis_(analysis) {
    while (auto entry = analysis.checkpoint.next("steady")) exchange(*entry);
  }
  /// Collective. Writes what has been added since the last entry, if it is time or, at the end, if
  /// it has taken long.
  void keep(bool isEnd = false) {
    const bool isLeft = isEnd && kept_ < analysis_.steady.size();
    if (!(isLeft && analysis_.checkpoint.isWorth(MPI_Wtime() - begin_)) &&
        !analysis_.checkpoint.due())
      return;
    checkpoint::Archive archive(analysis_.comm);
    exchange(archive);
    analysis_.checkpoint.write("steady", archive);
  }

 private:
  void exchange(checkpoint::Archive& archive) {
    std::size_t count = analysis_.steady.size();
    archive.common(count, analysis_.contactEvents);
    analysis_.steady.resize(count);
    for (; kept_ < count; ++kept_) steady::serialise(archive, analysis_.steady[kept_]);
    archive.own(analysis_.contactPath);  // of the whole path: it is short
  }
  Analysis& analysis_;
  std::size_t kept_ = 0;
  double begin_ = MPI_Wtime();  // s
};

/// Collective. Solves in the unknowns of the contact, with the factorisation of the closed one.
void condensedSweep(Analysis& analysis, const steady::Problem& problem,
                    const contact::CoupledSystem& closed) {
  const MPI_Comm comm = analysis.mesh->comm;
  const auto points = analysis.sweep.steadyPoints();
  const bool isExact = condensed::CondensedProblem::isExact(analysis.contact, analysis.bodies);
  std::vector<steady::Solution>& solutions = analysis.steady;
  std::optional<condensed::CondensedProblem> condensed;
  KeptStates states(analysis);
  if (solutions.size() < points.size()) closed.solver();
  while (solutions.size() < points.size()) {
    stopIfRequested(comm);
    Stage stage(comm, "steady");
    if (!condensed) {
      condensed.emplace(problem, closed);
      const auto last = std::ranges::find_if(solutions.rbegin(), solutions.rend(),
                                             [](const auto& one) { return one.converged; });
      if (last != solutions.rend()) condensed->continueFrom(*last);
    }
    const long before = condensed->solves();
    const std::size_t begin = solutions.size(), end = std::min(begin + mostTogether, points.size());
    for (auto& solution : condensed->solveTogether({points.begin() + begin, points.begin() + end}))
      solutions.push_back(std::move(solution));
    for (std::size_t k = begin; k < end; ++k) {
      if (!solutions[k].converged && isExact) continueFromNeighbour(analysis, *condensed, k);
      if (!solutions[k].converged && !isExact) solveFromBeside(analysis, *condensed, k);
      if (!solutions[k].converged) solveWithPivots(*condensed, solutions[k]);
      if (!solutions[k].converged && !isExact) {
        const std::string condensedReason = solutions[k].reason;
        solutions[k] = problem.solve(points[k], closed);
        solutions[k].reason += ", in all unknowns";
        if (!solutions[k].converged)
          solutions[k].reason += "; in those of the contact: " + condensedReason;
      }
      stage.printLine(resultText(analysis, solutions[k]));
      tell(analysis, solutions[k]);
    }
    stage.finish(
        formatted("%zu points, %ld right-hand sides", end - begin, condensed->solves() - before));
    if (isExact) {
      const auto ways = waysToFollow(analysis, begin);
      anticipate(analysis, *condensed, ways);
      for (const Way& way : ways) followPath(analysis, *condensed, way);
    }
    states.keep();
  }
  states.keep(true);
}

/// Collective. Solves in all unknowns.
void fullSweep(Analysis& analysis, const steady::Problem& problem, CurrentSystem& system) {
  std::vector<contact::ActiveSet> active;  // [steady point] of its solution, or the one tried
  KeptStates states(analysis);
  for (const auto& at : analysis.sweep.steadyPoints()) {
    const std::size_t k = active.size();
    const auto neighbour = analysis.sweep.earlierNeighbour(k);
    active.push_back(neighbour ? active[*neighbour] : bonded(analysis));
    if (k < analysis.steady.size()) {  // the checkpoint has it
      if (analysis.steady[k].converged) active.back() = steady::activeSet(analysis.steady[k]);
      continue;
    }
    stopIfRequested(analysis.comm);
    const auto& current = system.of(active.back());
    current.solver();
    Stage stage(analysis.mesh->comm, "steady");
    const auto& solution = analysis.steady.emplace_back(problem.solve(at, current));
    stage.finish(resultText(analysis, solution));
    tell(analysis, solution);
    if (solution.converged) active.back() = steady::activeSet(solution);
    states.keep();
  }
  states.keep(true);
}

}  // namespace

void steadySweep(Analysis& analysis, CurrentSystem& system) {
  const steady::Problem problem(*analysis.mesh, analysis.bodies, analysis.contact);
  if (analysis.settings.mesh->steady.full)
    fullSweep(analysis, problem, system);
  else
    condensedSweep(analysis, problem, system.of(bonded(analysis)));
}

}  // namespace squeal::analysis
