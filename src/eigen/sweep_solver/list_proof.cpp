// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/list_proof.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "base/session/events.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "eigen/completeness/completeness.hpp"
#include "eigen/sweep_solver/point_text.hpp"

namespace squeal::sweep_solver {
namespace {

/// Returns why the lists of a reduced problem need or allow no proof; empty if they do.
std::string whyNothing(const reduction::ReducedProblem& reduced) {
  const double top = reduced.band().top;
  if (std::isinf(top)) return "the basis is the whole space";
  return top == 0 || !reduced.grows() ? "only with -flutter_basis corrected" : "";
}

}  // namespace

std::vector<std::string> proveLists(const SweepProblem& problem, reduction::ReducedProblem& reduced,
                                    const modes::Modes& modes, std::vector<ListedPoint> points,
                                    const completeness::Settings& settings) {
  const MPI_Comm comm = reduced.basis().comm();
  if (const std::string why = whyNothing(reduced); !why.empty()) {
    printLine(comm, "proof: nothing to prove (" + why + ")");
    return {};
  }
  Stage stage(comm, "proof");
  const auto factors = problem.frictionFactors();
  std::map<std::size_t, completeness::ProvedSet> byRange;
  for (auto& [range, ofPoint, list] : points) {
    auto& set = byRange[range];
    if (factors.missing.empty()) set.rows = factors.rowsOf[range];
    set.problems.push_back(std::move(ofPoint));
    set.points.push_back(list);
  }
  std::vector<completeness::ProvedSet> sets;
  for (auto& [range, set] : byRange) sets.push_back(std::move(set));
  completeness::prove(reduced, *problem.system, modes, factors, sets, settings);
  std::size_t proved = 0;
  std::vector<std::string> failures;
  for (const auto& point : points) {
    stage.printLine(completenessText(*point.list));
    proved += point.list->listIsProved();
    if (const auto count = point.list->completeness->missing.size(); count > 0)
      failures.push_back(formatted("%s: the list lacks %zu eigenvalues of the full problem",
                                   sweep::parameterText(point.list->at).c_str(), count));
  }
  stage.finish(formatted("%zu of %zu lists proved to be complete, basis of %" PetscInt_FMT, proved,
                         points.size(), reduced.basisSize()));
  return failures;
}

}  // namespace squeal::sweep_solver
