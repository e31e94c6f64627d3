// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/mesh_flutter.hpp"

#include <algorithm>
#include <optional>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/columns.hpp"
#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "eigen/stability/continuation.hpp"
#include "problem/matrices/write.hpp"
#include "problem/terms/influence.hpp"
#include "run/analysis/mesh_sweep.hpp"
#include "run/analysis/point_groups.hpp"
#include "steady/steady/prestress.hpp"

namespace squeal::analysis {
namespace {

std::string groupText(const SlidingBrake& brake, const PointGroup& group) {
  const auto& solutions = brake.states.solutions;
  const std::size_t first = group.first + (group.continues ? 1 : 0);
  const std::string begin = sweep::parameterText(solutions[first].at);
  if (group.last - first == 1) return begin;
  return begin + " to " + sweep::parameterText(solutions[group.last - 1].at);
}

/// Collective. Adds the onsets of the unstable modes of a point.
void addOnsets(const SlidingBrake& brake, const pencil::ComplexModes& point, Flutter& found) try {
  const auto& [mesh, bodies, contact] = brake.model;
  const auto& solution = brake.states.at(point.at);
  const OwnedMat prestress = steady::prestressOf(*mesh, bodies, solution);
  for (auto& onset : regime::onsets(bodies, contact, solution, point, prestress))
    found.onsets.push_back(std::move(onset));
} catch (const Error& error) {
  found.addFailure(brake.comm(),
                   sweep::parameterText(point.at) + ": no first events: " + error.what());
}

/// Returns true if the motion after flutter is wanted at a point of the sweep.
bool isFollowed(const SlidingBrake& brake, const sweep::Parameters& at) {
  const sweep::Sweep& sweep = brake.sweep;
  return std::ranges::binary_search(brake.settings.regime.frictions, at.friction) &&
         at.speed == sweep.speeds.front() && at.pressure == sweep.pressures.front() &&
         at.damping == sweep.dampings.front();
}

/// Collective. Returns the free modes of a segment as nodal displacements, this rank's rows.
linalg::Block nodalModes(const SlidingBrake& brake, const MeshSweep& problem,
                         const sweep_solver::ModalSegment& segment) {
  const auto& mesh = *brake.model.mesh;
  linalg::Block modes(mesh.dimension * mesh.ownedNodes);
  const linalg::ReadColumns vectors(segment.modes.vectors);
  linalg::appendProduct(problem.trial, vectors.view(), modes);
  return modes;
}

/// Collective. Adds the motion after flutter at a point of a segment. A failure does not affect
/// other points.
void addRegime(const SlidingBrake& brake, const MeshSweep& problem, CurrentSystem& current,
               const sweep_solver::ModalSegment& segment, const pencil::ComplexModes& point,
               Flutter& found) try {
  const regime::FullModel full{brake.model.bodies, brake.model.contact,
                               current.of(brake.model.bonded()), brake.states.at(point.at),
                               point.at.damping};
  found.regimes.push_back(
      regime::study(full, brake.settings.regime, nodalModes(brake, problem, segment), point));
  const auto& failures = found.regimes.back().failures;
  found.failures.insert(found.failures.end(), failures.begin(), failures.end());
} catch (const Error& error) {
  found.addFailure(brake.comm(), sweep::parameterText(point.at) +
                                     ": not followed after flutter: " + error.what());
}

/// Collective. Writes the matrices of the pencil if `-report_matrices` wants them.
void exportPencil(const SlidingBrake& brake, const MeshSweep& problem) {
  const auto& settings = brake.settings.matrixExport;
  if (!settings.wanted()) return;
  // Terms of a point are absent only at friction 0, so the last point, which has the largest
  // friction, has them if any point has.
  const std::size_t points = problem.steadyPoints.size();
  matrices::exportPencil(problem.pencil->with(problem.termsOf(points - 1)), settings, brake.sweep,
                         points);
}

/// Returns the name of the checkpoint of a group.
std::string checkpointName(const PointGroup& group) {
  return "sets_" + std::to_string(group.first + 1) + (group.continues ? "_continued" : "");
}

/// Collective. Returns the results of a group of points.
Flutter solveGroup(const SlidingBrake& brake, MeshSweep& problem,
                   const sweep_solver::Request& request, checkpoint::Checkpoint& checkpoint) {
  auto solved =
      sweep_solver::solveSweep(problem, request, checkpoint, checkpointName(problem.group()));
  Flutter found{.segments = std::move(solved.segments), .complete = solved.complete};
  for (auto& segment : found.segments) problem.addComponents(segment);
  for (const auto& failure : solved.failures)
    found.addFailure(brake.comm(), groupText(brake, problem.group()) + ": " + failure);
  for (const auto& segment : found.segments)
    for (const auto& point : segment.points)
      if (brake.model.contact.interfaces.totalNodes > 0 && point.unstableCount() > 0)
        addOnsets(brake, point, found);
  return found;
}

/// Collective. Adds the motions after flutter at the points of a group that are to be followed.
void followAfterFlutter(const SlidingBrake& brake, const MeshSweep& problem, CurrentSystem& current,
                        Flutter& found) {
  found.complete = completed([&] {
    for (const auto& segment : found.segments)
      for (const auto& point : segment.points) {
        if (!isFollowed(brake, point.at)) continue;
        stopIfRequested(brake.comm());
        addRegime(brake, problem, current, segment, point, found);
      }
  });
}

/// Collective. Names the points that were to be followed and have no steady state to start from.
void nameUnfollowed(const SlidingBrake& brake, Flutter& found) {
  for (const auto& solution : brake.states.solutions) {
    auto at = solution.at;
    at.damping = brake.sweep.dampings.front();
    if (!solution.converged && isFollowed(brake, at))
      found.addFailure(brake.comm(), sweep::parameterText(at) +
                                         ": not followed after flutter (-regime_friction): no "
                                         "steady sliding state was found to start from");
  }
}

}  // namespace

Flutter meshFlutter(const SlidingBrake& brake, const sweep_solver::Request& request,
                    checkpoint::Checkpoint& checkpoint, CurrentSystem& current) {
  const auto& [mesh, bodies, contact] = brake.model;
  terms::Influences influences(*mesh, bodies, contact, brake.mesh().terms);
  const auto nodes = energies::nodesOfBodies(*mesh);
  const energies::Components components(
      *mesh, bodies, contact, nodes,
      energies::ownModes(*mesh, bodies, nodes, brake.mesh().ownModes));
  Flutter all{.ownModes = components.ownModes()};
  std::vector<std::string> lost;  // groups without results
  bool hasFailed = false;         // the preceding group
  std::string firstReason;
  for (PointGroup group : groupsOf(brake)) {
    if (group.continues && hasFailed) group.continues = false, ++group.first;
    hasFailed = false;
    const auto solve = [&] {
      stopIfRequested(brake.comm());
      MeshSweep problem(brake, group, std::ssize(all.segments), current, influences, components);
      exportPencil(brake, problem);
      Flutter found = solveGroup(brake, problem, request, checkpoint);
      if (found.complete) followAfterFlutter(brake, problem, current, found);
      for (auto& segment : found.segments) segment.modes.vectors = OwnedBV();  // no longer used
      all.append(std::move(found));
    };
    try {
      if (!completed(solve)) all.complete = false;
    } catch (const Error& error) {  // the other groups may have results
      if (lost.empty()) firstReason = error.what();
      lost.push_back(groupText(brake, group) + ": " + error.what());
      hasFailed = true;
    }
    if (!all.complete) break;
  }
  if (all.complete && !lost.empty() && all.segments.empty()) throw Error(firstReason);
  for (auto& segment : all.segments)
    for (auto& tracked : segment.trackedLines)
      stability::nameMissingEnd(tracked, brake.sweep.frictions.back());
  for (const auto& failure : lost) all.addFailure(brake.comm(), failure);
  if (all.complete) nameUnfollowed(brake, all);
  return all;
}

}  // namespace squeal::analysis
