// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/journal.hpp"

#include <algorithm>

#include "base/session/events.hpp"
#include "eigen/modes/serialization.hpp"
#include "eigen/pencil/serialization.hpp"
#include "eigen/stability/serialization.hpp"

namespace squeal::sweep_solver {

bool Journal::restoreFinished() {
  auto entry = checkpoint_.next(name_ + "_finished");
  if (!entry) return false;
  serialiseFinished(*entry);
  pointsDone(plan_.own(0, plan_.order.size()));
  return true;
}

std::optional<modes::Modes> Journal::restoredModes() {
  auto entry = checkpoint_.next(name_ + "_modes");
  if (!entry) return {};
  modes::Modes modes;
  modes::serialise(*entry, modes, problem_.system->k0());
  modesRecorded_ = true;
  return modes;
}

void Journal::restorePoints(reduction::ReducedProblem* basis) {
  while (auto entry = checkpoint_.next(name_ + "_points")) serialisePoints(*entry, basis);
  while (auto entry = checkpoint_.next(name_ + "_proofs")) serialiseProofs(*entry, {});
}

void Journal::record(modes::Modes& freeModes, reduction::ReducedProblem* basis) {
  if (!checkpoint_.due()) return;
  if (!modesRecorded_) {
    checkpoint::Archive archive(comm());
    modes::serialise(archive, freeModes, problem_.system->k0());
    checkpoint_.write(name_ + "_modes", archive);
    modesRecorded_ = true;
  }
  // A compressed basis does not only grow: a resumed run solves its points again.
  if (basis && !basis->grows()) return;
  checkpoint::Archive archive(comm());
  serialisePoints(archive, basis);
  checkpoint_.write(name_ + "_points", archive);
  recordProofs();
}

/// Collective. Records the proofs of points that were recorded without them.
void Journal::recordProofs() {
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < serialised_; ++k)
    if (pointAt(k).completeness && !proofs_.contains(k)) points.push_back(k);
  if (points.empty()) return;
  checkpoint::Archive archive(comm());
  serialiseProofs(archive, std::move(points));
  checkpoint_.write(name_ + "_proofs", archive);
}

/// Returns a point by its place in the order of the solution.
pencil::ComplexModes& Journal::pointAt(std::size_t k) {
  const PointPlace& place = plan_.places[plan_.order[k]];
  return state_.segments[place.range].points[place.inRange];
}

/// Collective. Writes the proofs of these points, or reads the points and their proofs.
void Journal::serialiseProofs(checkpoint::Archive& archive, std::vector<std::size_t> points) {
  archive.common(points);
  for (const std::size_t k : points) {
    bool whole = replaced_.contains(k);
    archive.common(whole);
    if (whole && archive.reads()) pointAt(k) = {};
    if (whole)
      pencil::serialise(archive, pointAt(k));
    else
      pencil::serialiseProof(archive, pointAt(k));
    proofs_.insert(k);
  }
}

void Journal::replace(const std::vector<std::size_t>& points) {
  for (std::size_t k = 0; k < plan_.order.size(); ++k) {
    if (std::ranges::find(points, plan_.order[k]) == points.end()) continue;
    proofs_.erase(k);
    replaced_.insert(k);
  }
}

void Journal::recordFinished() {
  if (!checkpoint_.isWorth(MPI_Wtime() - begin_)) return;
  checkpoint::Archive archive(comm());
  serialiseFinished(archive);
  checkpoint_.write(name_ + "_finished", archive);
}

/// Collective. Writes the part of the basis and the points that are new since the last call, or
/// reads and adds them.
void Journal::serialisePoints(checkpoint::Archive& archive, reduction::ReducedProblem* basis) {
  const std::size_t before = state_.solved;
  archive.common(state_.affine, state_.solved, state_.failures);
  if (basis) basis->serialise(archive);
  bool withModes = state_.hasSetModes && !setModesRecorded_;
  archive.common(withModes);
  if (withModes) {
    for (auto& segment : state_.segments)
      if (!segment.points.empty())
        modes::serialise(archive, segment.modes, problem_.substructure.stiffness);
    state_.hasSetModes = setModesRecorded_ = true;
  }
  for (; serialised_ < state_.solved; ++serialised_) {
    pencil::ComplexModes& point = pointAt(serialised_);
    pencil::serialise(archive, point);
    if (point.completeness) proofs_.insert(serialised_);
  }
  if (archive.reads()) pointsDone(plan_.own(before, state_.solved));
}

/// Collective. Writes or reads all reported results.
void Journal::serialiseFinished(checkpoint::Archive& archive) {
  const Mat all = problem_.substructure.stiffness;  // of all unknowns; null: all are interior
  std::size_t count = state_.segments.size();
  archive.common(count);
  state_.segments.resize(count);
  for (auto& segment : state_.segments) {
    archive.common(segment.openNodes, segment.unknowns, segment.solves, segment.trackedLines);
    modes::serialise(archive, segment.modes, all ? all : problem_.system->k0());
    std::size_t points = segment.points.size();
    archive.common(points);
    segment.points.resize(points);
    for (auto& point : segment.points) pencil::serialise(archive, point);
  }
}

}  // namespace squeal::sweep_solver
