// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/analysis.hpp"

#include <algorithm>

#include "base/session/events.hpp"
#include "eigen/stability/unlocated.hpp"
#include "run/analysis/checks.hpp"
#include "run/analysis/matrix_flutter.hpp"
#include "run/analysis/mesh_flutter.hpp"
#include "run/analysis/point_groups.hpp"
#include "run/analysis/tightening.hpp"

namespace squeal::analysis {
namespace {

/// Collective. Returns the checkpoint of a run in a folder; a disabled one without a folder.
checkpoint::Checkpoint openCheckpoint(MPI_Comm comm, const std::filesystem::path& folder,
                                      const Model& model, const checkpoint::Settings& settings) {
  if (folder.empty()) return {};
  auto identity = checkpoint::identityOfRun(comm);
  if (model.mesh) identity["the mesh"] = mesh::checksum(*model.mesh);
  return {comm, folder, std::move(identity), settings};
}

}  // namespace

bool Analysis::converged() const {
  return flutter.failures.empty() &&
         std::ranges::all_of(steady.solutions, &steady::Solution::converged);
}

const pencil::ComplexModes* Analysis::pointAt(const sweep::Parameters& at) const {
  for (const auto& segment : flutter.segments)
    for (const auto& point : segment.points)
      if (point.at == at) return &point;
  return nullptr;
}

Analysis analyse(MPI_Comm comm, const Settings& settings,
                 const std::filesystem::path& checkpointFolder, int reportedModes) {
  const sweep::Sweep sweep = sweep::grid(settings.sweep);
  Model model = settings.mesh ? buildModel(comm, settings.mesh->model) : Model{};
  std::optional<audit::Audit> audit;
  if (settings.mesh && settings.mesh->audit)
    audit = auditModel(model, settings.mesh->model, " (audit.md)");
  if (settings.mesh) {
    checkModel(model, settings, sweep);
    tightenBolts(model, settings.mesh->model.constraints);
  }
  checkpoint::Checkpoint checkpoint =
      openCheckpoint(comm, checkpointFolder, model, settings.checkpoint);
  expectPoints(sweep.points().size());
  const sweep_solver::Request request{
      .settings = settings.solver, .dampings = sweep.dampings, .reportedModes = reportedModes};
  SteadyStates steady;
  UniquenessStudy uniqueness;
  Flutter flutter{.complete = false};
  std::optional<JudgedList> judged;
  if (settings.referee) {
    judged = judgeList(comm, settings, sweep, flutter);
  } else if (!settings.mesh) {
    flutter = matrixFlutter(comm, settings, sweep, request, checkpoint);
  } else {
    CurrentSystem current(model);
    const bool fromZero = tracksFromZero(settings, model, sweep);
    steady = steadyStates({model, sweep, settings.mesh->steady, fromZero}, checkpoint, current);
    if (steady.complete) uniqueness = examineUniqueness(model, sweep, settings.mesh->uniqueness);
    if (steady.complete && uniqueness.complete)
      flutter = meshFlutter({settings, sweep, model, steady}, request, checkpoint, current);
  }
  if (settings.solver.stability.critical)
    for (auto& segment : flutter.segments)
      for (auto& tracked : segment.trackedLines) stability::addUnlocatedChanges(tracked);
  return {.comm = comm,
          .settings = settings,
          .sweep = sweep,
          .model = std::move(model),
          .audit = std::move(audit),
          .steady = std::move(steady),
          .uniqueness = std::move(uniqueness),
          .flutter = std::move(flutter),
          .judged = std::move(judged),
          .checkpoint = std::move(checkpoint)};
}

}  // namespace squeal::analysis
