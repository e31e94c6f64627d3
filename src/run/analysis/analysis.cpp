#include "run/analysis/analysis.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "base/session/events.hpp"
#include "base/system/termination.hpp"
#include "eigen/direct/nearest.hpp"
#include "eigen/pencil/settings.hpp"
#include "problem/matrices/matrices.hpp"
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
  return {.settings = sweep_solver::Settings::given(),
          .dampings = analysis.sweep.dampings,
          .reportedModes = analysis.reportedModes};
}

void addFailure(Analysis& analysis, const std::string& reason) {
  complain(analysis.comm, reason);
  analysis.failures.push_back(reason);
}

void checkOptions() {
  rejectUnknownOptions();
  const auto pencil = pencil::Settings::given();
  direct::rejectIdleSolverOptions(pencil.method);
  if (pencil.method == pencil::Method::direct && pencil.isModallyDamped())
    throw Error(
        "option -flutter_modal_damping: damping of the free modes needs the modes of "
        "-flutter_method reduced");
  sweep::grid(sweep::Settings::given());
  const bool ofMesh = matrices::Settings::given().ofMesh();
  regime::checkOptions(regime::Settings::given(), ofMesh);
  if (ofMesh) meshRequest();
}

/// Adds frictions to those of a sweep.
static void addFrictions(sweep::Sweep& sweep, const std::vector<double>& more) {
  for (const double friction : more)
    if (std::ranges::find(sweep.frictions, friction) == sweep.frictions.end())
      sweep.frictions.push_back(friction);
  std::ranges::sort(sweep.frictions);
}

Analysis prepare(MPI_Comm comm) {
  Analysis analysis;
  analysis.comm = comm;
  const bool ofMesh = matrices::Settings::given().ofMesh();
  analysis.sweep = sweep::grid(sweep::Settings::given());
  addFrictions(analysis.sweep, regime::Settings::given().frictions);
  if (ofMesh) {
    prepareMesh(analysis);
    warnOfDenseWork(comm, analysis.sweep, analysis.mesh->dimension * analysis.mesh->totalNodes);
  }
  return analysis;
}

Analysis analyse(MPI_Comm comm, const std::filesystem::path& checkpointFolder, int reportedModes) {
  Analysis analysis = prepare(comm);
  analysis.reportedModes = reportedModes;
  if (!checkpointFolder.empty()) {
    auto identity = checkpoint::identityOfRun(comm);
    if (analysis.mesh) identity["the mesh"] = mesh::checksum(*analysis.mesh);
    analysis.checkpoint = {comm, checkpointFolder, std::move(identity), checkpoint::resumeWanted()};
  }
  expectPoints(analysis.sweep.points().size());
  try {
    stopIfAsked(comm);
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
