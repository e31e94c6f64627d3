// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/set_modes.hpp"

#include <algorithm>
#include <utility>

#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "eigen/sweep_solver/mode_shapes.hpp"

namespace squeal::sweep_solver {

std::vector<modes::Modes> modesOfSets(reduction::ReducedProblem& reduced,
                                      const pencil::Pencil& pencil, const SweepProblem& problem,
                                      const modes::Modes& interior,
                                      const std::vector<int>& numbers) {
  Stage stage(pencil.comm(), "modes");
  std::vector<modes::Modes> result(numbers.size());
  std::vector<int> sets;
  std::vector<std::size_t> restricted;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const PointRange& range = problem.ranges[k];
    if (range.isPassed()) continue;
    if (std::ranges::count(range.has, 1) == 0) {
      result[k] = onAllUnknowns(interior, reduced.basis());
      continue;
    }
    sets.push_back(numbers[k]);
    restricted.push_back(k);
  }
  auto modes = reduced.freeModes(sets, pencil);
  for (std::size_t i = 0; i < restricted.size(); ++i) {
    const auto& residuals = modes[i].relativeResidual;
    stage.printLine(formatted("%zu free modes with %" PetscInt_FMT
                              " open nodes, residuals up to %.1e",
                              residuals.size(), problem.ranges[restricted[i]].openNodes,
                              residuals.empty() ? 0 : std::ranges::max(residuals)));
    result[restricted[i]] = std::move(modes[i]);
  }
  stage.finish(formatted("free modes of %zu active sets", restricted.size()));
  return result;
}

}  // namespace squeal::sweep_solver
