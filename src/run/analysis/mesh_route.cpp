// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/mesh_route.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/columns.hpp"
#include "base/options/options.hpp"
#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "model/contact/build.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/elasticity/element.hpp"
#include "model/mesh/read.hpp"
#include "model/ties/ties.hpp"
#include "problem/matrices/write.hpp"
#include "problem/terms/influence.hpp"
#include "regime/regime/regime.hpp"
#include "run/analysis/checks.hpp"
#include "run/analysis/mesh_sweep.hpp"
#include "run/analysis/model_settings.hpp"
#include "run/analysis/steady_sweep.hpp"
#include "steady/steady/prestress.hpp"
#include "steady/uniqueness/uniqueness.hpp"

namespace squeal::analysis {
namespace {

std::string unusedText(PetscInt nodes) {
  if (nodes == 0) return "";
  return nodes == 1 ? "; 1 node in no cell is not used"
                    : "; " + std::to_string(nodes) + " nodes in no cell are not used";
}

std::string straightenedText(const mesh::Straightened& done) {
  if (done.nodes == 0) return "";
  return formatted("; -mesh_straighten: %" PetscInt_FMT " nodes of %" PetscInt_FMT
                   " cells moved by up to %.3g m in %" PetscInt_FMT " rounds, %" PetscInt_FMT
                   " cells were folded",
                   done.nodes, done.cells, done.largestMove, done.rounds, done.folded);
}

mesh::Mesh readMesh(MPI_Comm comm, const ModelSettings& settings) {
  const mesh::Request request = meshRequest(settings);
  Stage stage(comm, "mesh");
  mesh::Mesh mesh = mesh::read(comm, request, settings.file, settings.mesh,
                               {elasticity::foldedAnywhere, elasticity::straightened});
  stage.finish(formatted(
      "%s: %" PetscInt_FMT " nodes, %" PetscInt_FMT " cells, %zu bodies in %d connected parts%s%s",
      settings.file.file.c_str(), mesh.totalNodes, mesh.totalCells, mesh.bodies.size(), mesh.parts,
      unusedText(mesh.unusedNodes).c_str(), straightenedText(mesh.straightened).c_str()));
  return mesh;
}

elasticity::Bodies assembleBodies(const mesh::Mesh& mesh, const ModelSettings& settings) {
  Stage stage(mesh.comm, "elasticity");
  elasticity::Bodies bodies = elasticity::assemble(mesh, settings.materials, settings.elasticity);
  stage.finish(formatted("stiffness, mass and loads on %" PetscInt_FMT " displacements",
                         mesh.dimension * mesh.totalNodes));
  return bodies;
}

interfaces::Interfaces findTies(mesh::Mesh& mesh, const interfaces::Settings& settings) {
  Stage stage(mesh.comm, "tie");
  auto ties = ties::findTies(mesh, settings);
  if (const auto found = ties::describeTies(ties); !found.empty()) stage.finish(found);
  return ties;
}

contact::Contact buildContact(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                              interfaces::Interfaces ties, const contact::Settings& settings) {
  Stage stage(mesh.comm, "contact");
  contact::Contact contact = contact::build(mesh, bodies, std::move(ties), settings);
  stage.finish(formatted("%" PetscInt_FMT " contact nodes on %zu interfaces",
                         contact.interfaces.totalNodes, contact.interfaces.names.size()));
  for (int i = 0; i < std::ssize(contact.interfaces.names); ++i)
    if (contact.interfaces.names.size() > 1 || !contact.interfaces.reports[i].matching)
      printLine(mesh.comm, "  " + interfaces::describe(contact.interfaces, i));
  return contact;
}

/// Collective. Examines uniqueness at each speed, or once where K and the slip are the same at all
/// speeds; loads do not matter.
std::vector<SpeedUniqueness> examineUniqueness(const Analysis& analysis,
                                               const uniqueness::Settings& settings) {
  std::vector<double> speeds = analysis.sweep.speeds;
  if (analysis.contact.slipIsConstant()) speeds.resize(1);
  std::vector<SpeedUniqueness> result;
  for (double speed : speeds) {
    stopIfRequested(analysis.comm);
    Stage stage(analysis.mesh->comm, "steady");
    result.push_back({speed, uniqueness::examine(analysis.bodies, analysis.contact, speed,
                                                 analysis.sweep.frictions, settings)});
    const auto& last = result.back().found.judgements.back();
    stage.finish(formatted("uniqueness at friction %g: %s (%s)", last.friction,
                           last.verdict.c_str(), last.reason.c_str()));
  }
  return result;
}

/// Returns the steady state of a point of the sweep.
const steady::Solution& steadyAt(const Analysis& analysis, sweep::Parameters at) {
  at.damping = 1;
  return *std::ranges::find_if(analysis.steady,
                               [&](const auto& solution) { return solution.at == at; });
}

/// Collective. Finds where the unstable modes of a point leave the linear range.
void findOnsets(Analysis& analysis, const pencil::ComplexModes& point) try {
  const auto& solution = steadyAt(analysis, point.at);
  const OwnedMat prestress = steady::prestressOf(*analysis.mesh, analysis.bodies, solution);
  for (auto& onset : regime::onsets(analysis.bodies, analysis.contact, solution, point, prestress))
    analysis.onsets.push_back(std::move(onset));
} catch (const Error& error) {
  addFailure(analysis, sweep::parameterText(point.at) + ": no first events: " + error.what());
}

/// Returns true if the motion after flutter is wanted at a point of the sweep.
bool isFollowed(const Analysis& analysis, const sweep::Parameters& at) {
  const sweep::Sweep& sweep = analysis.sweep;
  return std::ranges::binary_search(analysis.settings.regime.frictions, at.friction) &&
         at.speed == sweep.speeds.front() && at.pressure == sweep.pressures.front() &&
         at.damping == sweep.dampings.front();
}

/// Collective. Returns the free modes of a segment as nodal displacements, this rank's rows.
linalg::Block nodalModes(const Analysis& analysis, const MeshSweep& problem,
                         const sweep_solver::ModalSegment& segment) {
  linalg::Block modes(analysis.mesh->dimension * analysis.mesh->ownedNodes);
  const linalg::ReadColumns vectors(segment.modes.vectors);
  linalg::appendProduct(problem.trial, vectors.view(), modes);
  return modes;
}

/// Collective. Follows the motion after flutter at a point. What fails there leaves other points as
/// they are.
void followAfterFlutter(Analysis& analysis, const MeshSweep& problem, CurrentSystem& current,
                        const sweep_solver::ModalSegment& segment,
                        const pencil::ComplexModes& point) try {
  stopIfRequested(analysis.comm);
  const auto held = contact::ActiveSet::bonded(analysis.contact.interfaces.nodes.size());
  analysis.regimes.push_back(regime::study({analysis.bodies, analysis.contact, current.of(held),
                                            steadyAt(analysis, point.at), point.at.damping},
                                           analysis.settings.regime,
                                           nodalModes(analysis, problem, segment), point));
  const auto& failures = analysis.regimes.back().failures;
  analysis.failures.insert(analysis.failures.end(), failures.begin(), failures.end());
} catch (const Error& error) {
  addFailure(analysis,
             sweep::parameterText(point.at) + ": not followed after flutter: " + error.what());
}

/// Collective. Names the points that were to be followed and have no steady state to start from.
void nameUnfollowed(Analysis& analysis) {
  for (const auto& solution : analysis.steady) {
    auto at = solution.at;
    at.damping = analysis.sweep.dampings.front();
    if (!solution.converged && isFollowed(analysis, at))
      addFailure(analysis,
                 sweep::parameterText(at) +
                     ": not followed after flutter (-regime_friction): there is no steady "
                     "sliding to start from");
  }
}

/// Returns the steady points [first, last) in words.
std::string pointsText(const Analysis& analysis, std::size_t first, std::size_t last) {
  const std::string begin = sweep::parameterText(analysis.steady[first].at);
  return last - first == 1 ? begin
                           : begin + " to " + sweep::parameterText(analysis.steady[last - 1].at);
}

void solveMeshSweep(Analysis& analysis, std::size_t first, std::size_t last, CurrentSystem& current,
                    terms::Influences& influences) {
  MeshSweep problem(analysis, first, last, current, influences);
  // Terms of their own are absent at friction 0 alone: the last point, of the largest friction, has
  // them if any point has.
  if (const auto& settings = analysis.settings.matrixExport; settings.wanted())
    matrices::exportPencil(problem.pencil->with(problem.termsOf(last - first - 1)), settings,
                           analysis.sweep, last - first);
  const int before = std::ssize(analysis.segments);
  auto solved = sweep_solver::solveSweep(problem, requestOf(analysis), analysis.checkpoint,
                                         "sets_" + std::to_string(before + 1));
  for (auto& segment : solved.segments) {
    for (auto& tracked : segment.trackedLines)
      for (int& activeSet : tracked.activeSet)
        if (activeSet > 0) activeSet += before;
    analysis.segments.push_back(std::move(segment));
  }
  for (const auto& failure : solved.failures)
    addFailure(analysis, pointsText(analysis, first, last) + ": " + failure);
  const auto found = std::span(analysis.segments).subspan(before);
  for (const auto& segment : found)
    for (const auto& point : segment.points)
      if (analysis.contact.interfaces.totalNodes > 0 && point.unstableCount() > 0)
        findOnsets(analysis, point);
  if (!solved.complete) throw Interrupted();
  for (const auto& segment : found)
    for (const auto& point : segment.points)
      if (isFollowed(analysis, point.at))
        followAfterFlutter(analysis, problem, current, segment, point);
}

}  // namespace

void prepareMesh(Analysis& analysis) {
  const Settings& run = analysis.settings;
  const ModelSettings& settings = run.mesh->model;
  analysis.mesh = std::make_unique<mesh::Mesh>(readMesh(analysis.comm, settings));
  // before elements are made: it moves nodes
  auto ties = findTies(*analysis.mesh, settings.interfaces);
  analysis.bodies = assembleBodies(*analysis.mesh, settings);
  analysis.contact =
      buildContact(*analysis.mesh, analysis.bodies, std::move(ties), settings.contact);
  contact::requireMotion(analysis.contact);
  settleFriction(analysis.contact, run.frictionGiven, analysis.sweep);
  if (run.regime.enabled()) regime::requireSupported(run.regime, analysis.bodies, analysis.contact);
  requireFiniteSweep(analysis.bodies, analysis.contact, analysis.sweep);
  rejectIdleFactors(analysis.bodies, analysis.contact, run.pencil, analysis.sweep);
}

void solveMesh(Analysis& analysis) {
  CurrentSystem system(analysis);
  steadySweep(analysis, system);
  if (analysis.contact.interfaces.totalNodes > 0)
    if (const auto& settings = analysis.settings.mesh->uniqueness; settings.wanted)
      analysis.uniqueness = examineUniqueness(analysis, settings);
  std::vector<std::string> failures;
  std::string firstReason;
  terms::Influences influences(*analysis.mesh, analysis.bodies, analysis.contact,
                               analysis.settings.mesh->terms);
  for (std::size_t first = 0, last = 0; first < analysis.steady.size(); first = last) {
    last = first + 1;
    if (!analysis.steady[first].converged) continue;
    stopIfRequested(analysis.comm);
    last = endOfShared(analysis, first);
    try {
      solveMeshSweep(analysis, first, last, system, influences);
    } catch (const Error& error) {  // the other points may have results
      if (failures.empty()) firstReason = error.what();
      failures.push_back(pointsText(analysis, first, last) + ": " + error.what());
    }
  }
  if (!failures.empty() && analysis.segments.empty()) throw Error(firstReason);
  for (const auto& failure : failures) addFailure(analysis, failure);
  nameUnfollowed(analysis);
}

}  // namespace squeal::analysis
