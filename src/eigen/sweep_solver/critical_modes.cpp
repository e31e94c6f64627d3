// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/critical_modes.hpp"

#include "algebra/linalg/null_vectors.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "eigen/sensitivity/derive.hpp"

namespace squeal::sweep_solver {

void addCriticalModes(SweepProblem& problem, const reduction::ReducedProblem& reduced,
                      const stability::Line& line, bool derives,
                      const std::function<void(const std::string&)>& progress,
                      stability::TrackedLine& tracked) {
  for (const auto& critical : tracked.criticals) {
    auto& mode = tracked.criticalModes.emplace_back();
    // Equal eigenvalues that split at an end of the sweep have no slope, and neither has a jump.
    if (!critical.converged || critical.slope == 0) continue;
    const auto& [source, frictions, activeSet, like] = line.pieces.at(critical.piece);
    sweep::Parameters at = line.at;
    at.friction = critical.friction;
    const auto there = source.at(at);
    if (!there) continue;
    const sensitivity::CriticalPoint point{at, critical.angularFrequency,
                                           critical.kind == tracking::Event::Kind::crossing};
    const Complex s{0, point.angularFrequency};
    auto projected = reduced.project(*there);
    auto q = linalg::nullVectors(projected, s, point.isCrossing).right;
    mpi::broadcastEntries<Complex>(problem.system->comm(), q, 0);
    const auto& basis = reduced.basis();
    problem.describe(s, basis.expand({reduced.lifted(source.set, q)}).front(), *line.modes, mode);
    if (!derives) continue;
    progress(formatted("derivatives of the critical friction %.6g", critical.friction));
    const sensitivity::StartSpace start{basis.vectors(), problem.system->k0(),
                                        std::move(projected)};
    problem.withForms(at, like, there->pencil, [&](const sensitivity::Forms& forms) {
      sensitivity::deriveCritical(point, there->pencil, start, *problem.system, forms, mode);
    });
  }
}

}  // namespace squeal::sweep_solver
