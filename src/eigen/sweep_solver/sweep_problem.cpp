// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

std::vector<PathPiece> SweepProblem::path(std::size_t first, std::size_t count) const {
  const double friction = steadyPoints[first].friction;
  if (steps.empty()) return {{0, friction, steadyPoints[first + count - 1].friction}};
  std::vector<PathPiece> joined{{steps[first].back().range, friction, friction}};
  for (std::size_t i = first + 1; i < first + count; ++i)
    for (const auto& piece : steps[i])
      if (piece.range == joined.back().range && piece.from == joined.back().to)
        joined.back().to = piece.to;
      else if (piece.range)
        joined.push_back(piece);
  return joined;
}

}  // namespace squeal::sweep_solver
