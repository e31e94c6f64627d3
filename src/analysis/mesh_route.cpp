#include "analysis/mesh_route.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "analysis/checks.hpp"
#include "analysis/segment.hpp"
#include "analysis/steady_sweep.hpp"
#include "contact/coupled.hpp"
#include "elasticity/elasticity.hpp"
#include "elasticity/element.hpp"
#include "elasticity/ground.hpp"
#include "elasticity/material.hpp"
#include "flutter/influence.hpp"
#include "flutter/terms.hpp"
#include "flutter/work.hpp"
#include "interfaces/interfaces.hpp"
#include "interfaces/ties.hpp"
#include "matrices/write.hpp"
#include "mesh/read.hpp"
#include "modes/benchmark.hpp"
#include "modes/modes.hpp"
#include "options/options.hpp"
#include "petsc/text.hpp"
#include "sensitivity/sensitivity.hpp"
#include "session/stages.hpp"
#include "steady/steady.hpp"
#include "uniqueness/uniqueness.hpp"

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

mesh::Mesh readMesh(MPI_Comm comm) {
  const mesh::Request request = meshRequest();
  Stage stage(comm, "mesh");
  mesh::Mesh mesh = mesh::read(comm, request);
  stage.finish(formatted(
      "%s: %" PetscInt_FMT " nodes, %" PetscInt_FMT " cells, %zu bodies in %d connected parts%s%s",
      resolvedOptions().at("mesh_file").c_str(), mesh.totalNodes, mesh.totalCells,
      mesh.bodies.size(), mesh.parts, unusedText(mesh.unusedNodes).c_str(),
      straightenedText(mesh.straightened).c_str()));
  return mesh;
}

elasticity::Bodies assembleBodies(const mesh::Mesh& mesh) {
  Stage stage(mesh.comm, "elasticity");
  elasticity::Bodies bodies = elasticity::assemble(mesh);
  stage.finish(formatted("stiffness, mass and loads on %" PetscInt_FMT " displacements",
                         mesh.dimension * mesh.totalNodes));
  return bodies;
}

interfaces::Interfaces findTies(mesh::Mesh& mesh) {
  Stage stage(mesh.comm, "tie");
  auto ties = interfaces::findTies(mesh);
  if (const auto found = interfaces::describeTies(ties); !found.empty()) stage.finish(found);
  return ties;
}

contact::Contact buildContact(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                              interfaces::Interfaces ties) {
  Stage stage(mesh.comm, "contact");
  contact::Contact contact = contact::build(mesh, bodies, std::move(ties));
  stage.finish(formatted("%" PetscInt_FMT " contact nodes on %zu interfaces", contact.totalNodes,
                         contact.interfaces.size()));
  for (int i = 0; i < std::ssize(contact.interfaces); ++i)
    if (contact.interfaces.size() > 1 || !contact.reports[i].matching)
      say(mesh.comm, "  " + interfaces::describe(contact, i));
  return contact;
}

/// Collective. Examines uniqueness at each speed, or once where K and the slip are the same at all
/// speeds; loads do not matter.
std::vector<SpeedUniqueness> examineUniqueness(const Analysis& analysis) {
  std::vector<double> speeds = analysis.sweep.speeds;
  if (analysis.contact.slipIsGiven()) speeds.resize(1);
  std::vector<SpeedUniqueness> result;
  for (double speed : speeds) {
    Stage stage(analysis.mesh->comm, "steady");
    result.push_back({speed, uniqueness::examine(analysis.bodies, analysis.contact, speed,
                                                 analysis.sweep.frictions)});
    const auto& last = result.back().found.judgements.back();
    stage.finish(formatted("uniqueness at friction %g: %s (%s)", last.friction,
                           last.verdict.c_str(), last.reason.c_str()));
  }
  return result;
}

/// Collective. Computes the friction work of the shapes and, if wanted, the sensitivities of their
/// eigenvalues.
void examineShapes(const Analysis& analysis, const contact::CoupledSystem& system,
                   const steady::Solution& solution, const pencil::Pencil& pencil,
                   const sensitivity::StartSpace& start, flutter::Influences& influences,
                   pencil::ComplexModes& point) {
  if (point.shapes.empty()) return;
  OwnedMat prestress;
  if (elasticity::prestressWanted())
    prestress = elasticity::geometricStiffness(*analysis.mesh, solution.displacement);
  const auto friction = flutter::frictionState(analysis.contact, solution);
  for (auto& shape : point.shapes)
    shape.frictionWork = flutter::frictionWork(
        analysis.contact, analysis.bodies, solution.closed, friction, point.at,
        point.eigenvalues[shape.index].s,
        linalg::ComplexVector::copied(shape.real, shape.imaginary), prestress);
  if (!sensitivity::sensitivitiesWanted()) return;
  Stage stage(analysis.mesh->comm, "flutter");
  influences.derive(point, pencil, {point.at, system, solution, prestress}, start);
  double error = 0;
  for (const auto& sensitivity : point.sensitivities)
    error = std::max(error, sensitivity.leftBackwardError);
  stage.finish(formatted("%s: sensitivities of %zu eigenvalues, worst left backward error %.1e",
                         sweep::parameterText(point.at).c_str(), point.sensitivities.size(),
                         error));
}

/// The steady points [first, last), which share one active set.
class MeshSegment : public SegmentProblem {
 public:
  /// Collective. Borrows all arguments during the life of the object.
  MeshSegment(const Analysis& analysis, std::size_t first, std::size_t last, CurrentSystem& current,
              flutter::Influences& influences)
      : analysis_(analysis), first_(first), current_(current), influences_(influences) {
    for (std::size_t i = first; i < last; ++i) points_.push_back(analysis.steady[i].at);
    if (elasticity::prestressWanted()) {
      prestress_ = elasticity::geometricStiffness(*analysis.mesh, reference().displacement);
      stressed_ = std::make_unique<contact::CoupledSystem>(analysis.bodies, analysis.contact,
                                                           reference().closed, prestress_,
                                                           reference().sticking.free());
    }
    system_ = stressed_ ? stressed_.get() : &current.of(activeSet(reference()));
  }
  const contact::CoupledSystem& system() const override { return *system_; }
  Mat trial() const override { return system_->transformation().trial; }
  const std::vector<sweep::Parameters>& steadyPoints() const override { return points_; }
  pencil::Pencil pencil() const override {
    return flutter::affineTerms(analysis_.contact, system());
  }
  std::vector<pencil::Term> termsOf(std::size_t i) const override {
    return termsOf(analysis_.steady[first_ + i]);
  }
  std::optional<std::vector<pencil::Term>> termsAt(const sweep::Parameters& at) override {
    sweep::Parameters steady = at;
    steady.damping = 1;
    const auto known = std::find_if(analysis_.steady.begin(), analysis_.steady.end(),
                                    [&](const auto& solution) { return solution.at == steady; });
    if (known != analysis_.steady.end()) return termsIfShared(*known);
    if (!problem_)
      problem_ =
          std::make_unique<steady::Problem>(*analysis_.mesh, analysis_.bodies, analysis_.contact);
    return termsIfShared(problem_->solve(steady, current_.of(activeSet(reference()))));
  }
  void examine(std::size_t i, const pencil::Pencil& pencil, const sensitivity::StartSpace& start,
               pencil::ComplexModes& point) override {
    examineShapes(analysis_, system(), analysis_.steady[first_ + i], pencil, start, influences_,
                  point);
  }

 private:
  /// Returns the first steady state, whose geometric stiffness is in K0.
  const steady::Solution& reference() const { return analysis_.steady[first_]; }
  std::vector<pencil::Term> termsOf(const steady::Solution& solution) const {
    OwnedMat change;
    if (prestress_ && &solution != &reference()) {
      change = elasticity::geometricStiffness(*analysis_.mesh, solution.displacement);
      check(MatAXPY(change, -1, prestress_, SAME_NONZERO_PATTERN));
    }
    return flutter::pointTerms(analysis_.contact, system(), solution, change);
  }
  std::optional<std::vector<pencil::Term>> termsIfShared(const steady::Solution& solution) const {
    if (!solution.converged ||
        !sameOnAllRanks(analysis_.mesh->comm, activeSet(solution), activeSet(reference())))
      return {};
    return termsOf(solution);
  }

  const Analysis& analysis_;
  std::size_t first_;
  CurrentSystem& current_;
  flutter::Influences& influences_;
  std::vector<sweep::Parameters> points_;
  OwnedMat prestress_;
  std::unique_ptr<contact::CoupledSystem> stressed_;  // with prestress
  const contact::CoupledSystem* system_ = nullptr;
  std::unique_ptr<steady::Problem> problem_;  // for points between those of the sweep
};

void solveMeshSegment(Analysis& analysis, std::size_t first, std::size_t last,
                      CurrentSystem& current, flutter::Influences& influences) {
  MeshSegment problem(analysis, first, last, current, influences);
  // Terms of their own are absent at friction 0 alone: the last point, of the largest friction, has
  // them if any point has.
  if (matrices::exportWanted())
    matrices::exportPencil(problem.pencil().with(problem.termsOf(last - first - 1)), analysis.sweep,
                           last - first);
  ModalSegment segment = solveSegment(problem, analysis.sweep.dampings);
  segment.openNodes = problem.system().openNodes();
  analysis.segments.push_back(std::move(segment));
  if (modes::benchmarkWanted())
    analysis.modesFloorSeconds = modes::floorSeconds(problem.system().k0());
}

}  // namespace

mesh::Request meshRequest() {
  mesh::Request request;
  request.geometry = {elasticity::foldedAnywhere, elasticity::straightened};
  request.bodies = elasticity::materialGroups();
  request.moving = elasticity::movingBodies();
  request.nodeGroups = interfaces::constrainedGroups();
  for (const auto& group : elasticity::groundedGroups()) request.nodeGroups.push_back(group);
  request.surfaces = elasticity::loadedSurfaces();
  request.interfaces = interfaces::readInterfaces();
  request.periodic = interfaces::periodicPairs();
  request.howToGiveMaterials = elasticity::howToGiveMaterials();
  request.motionOptions = elasticity::motionOptions();
  return request;
}

void prepareMesh(Analysis& analysis) {
  analysis.mesh = std::make_unique<mesh::Mesh>(readMesh(analysis.comm));
  auto ties = findTies(*analysis.mesh);  // before elements are made: it moves nodes
  analysis.bodies = assembleBodies(*analysis.mesh);
  analysis.contact = buildContact(*analysis.mesh, analysis.bodies, std::move(ties));
  contact::requireMotion(analysis.contact);
  settleFriction(analysis.contact, analysis.sweep);
  requireFiniteSweep(analysis.bodies, analysis.contact, analysis.sweep);
  rejectIdleFactors(analysis.bodies, analysis.contact, analysis.sweep);
}

void solveMesh(Analysis& analysis) {
  CurrentSystem system(analysis);
  steadySweep(analysis, system);
  if (analysis.contact.totalNodes > 0 && uniqueness::uniquenessWanted())
    analysis.uniqueness = examineUniqueness(analysis);
  flutter::Influences influences(*analysis.mesh, analysis.bodies, analysis.contact);
  for (std::size_t first = 0, last = 0; first < analysis.steady.size(); first = last) {
    last = first + 1;
    const auto& start = analysis.steady[first];
    if (!start.converged) continue;
    while (last < analysis.steady.size() && analysis.steady[last].converged &&
           sameOnAllRanks(analysis.comm, activeSet(analysis.steady[last]), activeSet(start)))
      ++last;
    solveMeshSegment(analysis, first, last, system, influences);
  }
}

}  // namespace squeal::analysis
