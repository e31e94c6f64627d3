// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/list_proof.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/session/events.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "eigen/completeness/completeness.hpp"
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

}  // namespace

void proveLists(const SweepProblem& problem, reduction::ReducedProblem& reduced,
                const modes::Modes& modes, std::vector<ListedPoint> points,
                const ProofRequest& request) {
  const MPI_Comm comm = reduced.basis().comm();
  if (const std::string why = whyNothing(reduced); !why.empty()) {
    return printLine(comm, "proof: nothing to prove (" + why + ")");
  }
  const auto [factors, rowsOf] = problem.frictionFactors();
  std::map<std::size_t, completeness::ProvedSet> byRange;
  std::vector<ListedPoint*> others;
  for (auto& point : points) {
    // A resumed run tries again where an earlier one ended with an error, for example of memory.
    if (const auto& known = point.list->completeness; known && known->top > 0) continue;
    if (!completeness::covers(point.problem, factors)) {
      others.push_back(&point);
      continue;
    }
    auto& set = byRange[point.range];
    set.rows = rowsOf[point.range];
    set.problems.push_back({point.problem.at, point.problem.pencil.with({}), point.problem.set});
    set.points.push_back(point.list);
  }
  std::vector<completeness::ProvedSet> sets;
  for (auto& [range, set] : byRange) sets.push_back(std::move(set));
  proveSingly(problem, reduced, others, request);
  std::optional<Stage> stage;
  if (!sets.empty()) {
    stage.emplace(comm, "proof");
    completeness::prove(reduced, *problem.system, modes, factors, sets, request.settings);
    for (const auto& set : sets)
      for (const auto* list : set.points) stage->printLine(completenessText(*list));
  }
  const auto proved =
      std::ranges::count_if(points, [](const auto& point) { return point.list->listIsProved(); });
  const std::string text =
      formatted("%td of %zu lists proved to be complete", proved, points.size());
  if (stage)
    stage->finish(text + formatted(", basis of %" PetscInt_FMT, reduced.basisSize()));
  else
    printLine(comm, "proof: " + text);
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
