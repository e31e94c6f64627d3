// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/point_solution.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "eigen/direct/direct.hpp"
#include "eigen/sweep_solver/point_text.hpp"
#include "eigen/sweep_solver/results.hpp"

namespace squeal::sweep_solver {

std::vector<pencil::ComplexModes> solvedPoints(reduction::ReducedProblem* reduced,
                                               const std::vector<reduction::PointProblem>& problems,
                                               Mat trial, const Settings& settings) {
  std::vector<pencil::ComplexModes> points;
  if (reduced)
    points = reduced->solve(problems, trial);
  else
    for (const auto& problem : problems)
      points.push_back(direct::solveDirect(problem.pencil, problem.at, trial, *settings.direct));
  for (const auto& point : points) requireFiniteEigenvalues(point);
  return points;
}

std::vector<std::size_t> commonPoints(const std::vector<std::size_t>& batch,
                                      const std::vector<std::size_t>& points) {
  std::vector<std::size_t> common;
  std::ranges::copy_if(batch, std::back_inserter(common),
                       [&](std::size_t i) { return std::ranges::find(points, i) != points.end(); });
  return common;
}

std::string solveAgain(const std::vector<pencil::ComplexModes*>& points,
                       const std::function<void()>& solve) {
  std::vector<pencil::ComplexModes> before;
  for (auto* point : points) before.push_back(std::exchange(*point, {}));
  std::string failure;
  try {
    solve();
  } catch (const Error& error) {
    failure = error.what();
  }
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!isSolved(*points[k])) *points[k] = std::move(before[k]);
  return failure;
}

}  // namespace squeal::sweep_solver
