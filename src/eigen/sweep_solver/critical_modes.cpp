// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/critical_modes.hpp"

#include "algebra/linalg/null_vectors.hpp"
#include "base/session/stages.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "eigen/sensitivity/derive.hpp"

namespace squeal::sweep_solver {
namespace {

constexpr std::size_t together = 16;  // critical frictions, whose problems are in memory

/// A critical friction with its problem.
struct Place {
  std::size_t index;  // in the list of the line
  sensitivity::CriticalPoint point;
  const stability::LinePiece* piece;
  reduction::PointProblem problem;
  linalg::DenseProblem projected;                                  // on the basis
  std::function<sensitivity::Forms(const pencil::Pencil&)> forms;  // empty: not derived
  Complex s() const { return {0, point.angularFrequency}; }
};

/// Collective. Returns critical frictions from one on that are roots of a function, and sets it to
/// the next one. Equal eigenvalues that split at an end of the sweep have no slope, and neither has
/// a jump. Each steady state is found once, for the terms and the derivatives.
std::vector<Place> nextPlaces(SweepProblem& problem, reduction::ReducedProblem& reduced,
                              const stability::Line& line, bool derives,
                              const stability::TrackedLine& tracked, std::size_t& next) {
  std::vector<Place> places;
  while (next < tracked.criticals.size() && places.size() < together) {
    const std::size_t i = next++;
    const auto& critical = tracked.criticals[i];
    if (!critical.converged || critical.slope == 0) continue;
    const auto& piece = line.pieces.at(critical.piece);
    sweep::Parameters at = line.at;
    at.friction = critical.friction;
    const tracking::ProblemSource& source = piece.source;
    std::optional<PointBetween> between;
    if (derives || !source.local) between = problem.between(at, piece.range);
    if (!between) {
      if (derives)
        printWarning(reduced.basis().comm(),
                     formatted("no derivatives of the critical friction %.6g, since no steady "
                               "state with its active set was found",
                               at.friction));
      if (!source.local) continue;
      between.emplace();
    }
    reduction::PointProblem there{at, source.shared().with(std::move(between->terms)), source.set};
    auto projected = reduced.project(there);
    const bool isCrossing = critical.kind == tracking::Event::Kind::crossing;
    places.push_back({i,
                      {at, critical.angularFrequency, isCrossing},
                      &piece,
                      std::move(there),
                      std::move(projected),
                      derives ? std::move(between->forms) : nullptr});
  }
  return places;
}

/// Collective. Returns the modes there in the unknowns, [place].
std::vector<linalg::ComplexVector> vectorsOf(const reduction::ReducedProblem& reduced,
                                             const std::vector<Place>& places) {
  std::vector<std::vector<Complex>> lifted;
  for (const auto& place : places) {
    auto q = linalg::nullVectors(place.projected, place.s(), place.point.isCrossing).right;
    mpi::broadcastEntries<Complex>(reduced.basis().comm(), q, 0);
    lifted.push_back(reduced.lifted(place.piece->source.set, q));
  }
  return reduced.basis().expand(lifted);
}

}  // namespace

void addCriticalModes(SweepProblem& problem, reduction::ReducedProblem& reduced,
                      const stability::Line& line, bool derives,
                      const std::function<void(const std::string&)>& progress,
                      stability::TrackedLine& tracked) {
  tracked.criticalModes.resize(tracked.criticals.size());
  for (std::size_t next = 0; next < tracked.criticals.size();) {
    auto places = nextPlaces(problem, reduced, line, derives, tracked, next);
    if (places.empty()) return;
    const auto vectors = vectorsOf(reduced, places);
    std::vector<pencil::ComplexMotion> motions;
    for (std::size_t i = 0; i < places.size(); ++i) motions.push_back({places[i].s(), &vectors[i]});
    auto found = problem.describe(motions, *line.modes);
    for (std::size_t i = 0; i < places.size(); ++i) {
      auto& [index, point, piece, at, projected, forms] = places[i];
      auto& mode = tracked.criticalModes[index] = std::move(found[i]);
      if (!forms) continue;
      progress(formatted("derivatives of the critical friction %.6g", point.at.friction));
      const sensitivity::StartSpace start{reduced.basis().columns(), problem.system->k0(),
                                          std::move(projected)};
      sensitivity::deriveCritical(point, at.pencil, start, *problem.system, forms(at.pencil), mode);
    }
  }
}

}  // namespace squeal::sweep_solver
