// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/analysis.hpp"

#include <algorithm>

#include "base/session/events.hpp"
#include "base/system/termination.hpp"
#include "run/analysis/checks.hpp"
#include "run/analysis/matrix_route.hpp"
#include "run/analysis/mesh_route.hpp"

namespace squeal::analysis {

bool Analysis::converged() const {
  return failures.empty() && std::ranges::all_of(steady, &steady::Solution::converged);
}

const pencil::ComplexModes* Analysis::pointAt(const sweep::Parameters& at) const {
  for (const auto& segment : segments)
    for (const auto& point : segment.points)
      if (point.at == at) return &point;
  return nullptr;
}

sweep_solver::Request requestOf(const Analysis& analysis) {
  return {.settings = analysis.settings.solver,
          .dampings = analysis.sweep.dampings,
          .reportedModes = analysis.reportedModes};
}

void addFailure(Analysis& analysis, const std::string& reason) {
  printWarning(analysis.comm, reason);
  analysis.failures.push_back(reason);
}

Analysis prepare(MPI_Comm comm, const Settings& settings) {
  Analysis analysis;
  analysis.comm = comm;
  analysis.settings = settings;
  analysis.sweep = sweep::grid(settings.sweep);
  if (settings.mesh) {
    prepareMesh(analysis);
    warnOfDenseWork(comm, settings, analysis.sweep,
                    analysis.mesh->dimension * analysis.mesh->totalNodes);
  }
  return analysis;
}

Analysis analyse(MPI_Comm comm, const Settings& settings,
                 const std::filesystem::path& checkpointFolder, int reportedModes) {
  Analysis analysis = prepare(comm, settings);
  analysis.reportedModes = reportedModes;
  if (!checkpointFolder.empty()) {
    auto identity = checkpoint::identityOfRun(comm);
    if (analysis.mesh) identity["the mesh"] = mesh::checksum(*analysis.mesh);
    analysis.checkpoint = {comm, checkpointFolder, std::move(identity), settings.checkpoint};
  }
  expectPoints(analysis.sweep.points().size());
  try {
    stopIfRequested(comm);
    if (analysis.mesh)
      solveMesh(analysis);
    else
      solveMatrices(analysis);
  } catch (const Interrupted&) {
    analysis.interrupted = true;
  }
  return analysis;
}

}  // namespace squeal::analysis
