// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/list_proof.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "base/session/events.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "eigen/completeness/completeness.hpp"
#include "eigen/completeness/damped.hpp"
#include "eigen/sweep_solver/point_text.hpp"
#include "eigen/sweep_solver/single_proofs.hpp"

namespace squeal::sweep_solver {
namespace {

/// Returns why the lists of a reduced problem need or allow no proof; empty if they do.
std::string whyNothing(const reduction::ReducedProblem& reduced) {
  const double top = reduced.band().top;
  if (std::isinf(top)) return "the basis is the whole space";
  return top == 0 || !reduced.grows() ? "only with -flutter_basis corrected" : "";
}

/// Collective. Proves the lists of points that completeness::coversDamped() in the basis of the
/// sweep. Returns the points whose number of eigenvalues is not proved; nothing is recorded for
/// them.
std::vector<ListedPoint*> proveDamped(const SweepProblem& problem,
                                      reduction::ReducedProblem& reduced, const modes::Modes& modes,
                                      const pencil::JumpFactors& factors,
                                      const std::vector<ListedPoint*>& points,
                                      const ProofRequest& request) {
  if (points.empty()) return {};
  std::vector<completeness::DampedList> lists;
  for (const auto* point : points)
    lists.push_back({&point->problem, point->list,
                     [&problem, i = point->place.steadyPoint] { return problem.factorsAt(i); }});
  Stage stage(reduced.basis().comm(), "proof");
  const auto report = [&](const std::vector<pencil::ComplexModes*>& judged) {
    for (auto* list : judged) {
      stage.printLine(completenessText(*list));
      if (!list->completeness->proved) list->completeness.reset();
    }
    if (request.afterPoints) request.afterPoints();
  };
  std::string failure;
  try {
    completeness::proveDamped(reduced,
                              {.system = *problem.system,
                               .modes = modes,
                               .interior = problem.substructure.interior,
                               .factors = factors,
                               .settings = request.settings,
                               .afterPoints = report},
                              lists);
  } catch (const Error& error) {
    failure = std::string(", ended by: ") + error.what();
  }
  stage.finish(formatted("%zu points with terms of speed or damping, basis of %" PetscInt_FMT,
                         points.size(), reduced.basisSize()) +
               failure);
  std::vector<ListedPoint*> left;
  std::ranges::copy_if(points, std::back_inserter(left), [](const ListedPoint* point) {
    const auto& found = point->list->completeness;
    return !found || !found->proved;
  });
  return left;
}

/// Collective. Proves the lists of points whose terms are the same at all points.
void proveTogether(const SweepProblem& problem, reduction::ReducedProblem& reduced,
                   const modes::Modes& modes, const RangeFactors& factors,
                   const std::vector<ListedPoint*>& points, const ProofRequest& request) {
  if (points.empty()) return;
  std::map<std::size_t, completeness::ProvedSet> byRange;
  for (const auto* point : points) {
    auto& set = byRange[point->place.range];
    set.rows = factors.rowsOf[point->place.range];
    set.problems.push_back({point->problem.at, point->problem.pencil.with({}), point->problem.set});
    set.points.push_back(point->list);
  }
  std::vector<completeness::ProvedSet> sets;
  for (auto& [range, set] : byRange) sets.push_back(std::move(set));
  Stage stage(reduced.basis().comm(), "proof");
  completeness::prove(reduced, *problem.system, modes, factors.factors, sets, request.settings);
  for (const auto& set : sets)
    for (const auto* list : set.points) stage.printLine(completenessText(*list));
  stage.finish(formatted("basis of %" PetscInt_FMT, reduced.basisSize()));
}

}  // namespace

void proveLists(const SweepProblem& problem, reduction::ReducedProblem& reduced,
                const modes::Modes& modes, std::vector<ListedPoint> points,
                const ProofRequest& request) {
  const MPI_Comm comm = reduced.basis().comm();
  if (const std::string why = whyNothing(reduced); !why.empty()) {
    return printLine(comm, "proof: not attempted (" + why + ")");
  }
  const auto factors = problem.frictionFactors();
  const auto jumps = problem.jumpFactors();
  std::vector<ListedPoint*> alike, damped, others;
  for (auto& point : points) {
    // A resumed run tries again where an earlier one ended with an error, for example of memory.
    if (const auto& known = point.list->completeness; known && known->top > 0) continue;
    const bool isAlike = completeness::covers(point.problem, factors.factors);
    (isAlike                                            ? alike
     : completeness::coversDamped(point.problem, jumps) ? damped
                                                        : others)
        .push_back(&point);
  }
  for (auto* point : proveDamped(problem, reduced, modes, jumps, damped, request))
    others.push_back(point);
  proveSingly(problem, reduced, others, request);
  proveTogether(problem, reduced, modes, factors, alike, request);
  const auto proved =
      std::ranges::count_if(points, [](const auto& point) { return point.list->listIsProved(); });
  printLine(comm,
            formatted("proof: %td of %zu lists proved to be complete", proved, points.size()));
}

std::vector<std::string> faultsOf(const pencil::ComplexModes& point) {
  std::vector<std::string> faults;
  if (!point.completeness) return faults;
  const std::string at = sweep::parameterText(point.at);
  if (const auto count = point.completeness->missing.size(); count > 0)
    faults.push_back(
        formatted("%s: the list lacks %zu eigenvalues of the full problem", at.c_str(), count));
  if (const auto count = point.completeness->spurious.size(); count > 0)
    faults.push_back(formatted("%s: %zu values of the list are not eigenvalues of the full problem",
                               at.c_str(), count));
  return faults;
}

bool mayLackEigenvalues(const pencil::ComplexModes& point, pencil::WatchedBand band) {
  band.top = point.bandTop;
  return !faultsOf(point).empty() ||
         (point.completeness && std::ranges::any_of(point.completeness->undecided,
                                                    [&](Complex s) { return band.contains(s); }));
}

}  // namespace squeal::sweep_solver
