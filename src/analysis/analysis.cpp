#include "analysis/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/coupled.hpp"
#include "direct/direct.hpp"
#include "elasticity/elasticity.hpp"
#include "flutter/influence.hpp"
#include "flutter/terms.hpp"
#include "flutter/work.hpp"
#include "linalg/complexvector.hpp"
#include "linalg/finite.hpp"
#include "mesh/mesh.hpp"
#include "options/options.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "petsc/text.hpp"
#include "sensitivity/derive.hpp"
#include "sensitivity/left.hpp"
#include "sensitivity/sensitivity.hpp"
#include "session/stages.hpp"
#include "sweep/parameters.hpp"
#include "sweep/sweep.hpp"

namespace squeal::analysis {
namespace {

std::string unusedText(PetscInt nodes) {
  if (nodes == 0) return "";
  return nodes == 1 ? "; 1 node in no cell is not used"
                    : formatted("; %d nodes in no cell are not used", static_cast<int>(nodes));
}

mesh::Mesh readMesh(MPI_Comm comm) {
  const mesh::Request request = meshRequest();
  Stage stage(comm, "mesh");
  mesh::Mesh mesh = mesh::read(comm, request);
  stage.finish(formatted("%s: %d nodes, %d cells, %d bodies in %d connected parts%s",
                         resolvedOptions().at("mesh_file").c_str(),
                         static_cast<int>(mesh.totalNodes), static_cast<int>(mesh.totalCells),
                         static_cast<int>(mesh.bodies.size()), mesh.parts,
                         unusedText(mesh.unusedNodes).c_str()));
  return mesh;
}

elasticity::Bodies assembleBodies(const mesh::Mesh& mesh) {
  Stage stage(mesh.comm, "elasticity");
  elasticity::Bodies bodies = elasticity::assemble(mesh);
  stage.finish(formatted("stiffness, mass and loads on %d displacements",
                         static_cast<int>(mesh.dimension * mesh.totalNodes)));
  return bodies;
}

contact::Contact buildContact(const mesh::Mesh& mesh, const elasticity::Bodies& bodies) {
  Stage stage(mesh.comm, "contact");
  contact::Contact contact = contact::build(mesh, bodies);
  stage.finish(
      formatted("%d contact nodes on %d interfaces%s", static_cast<int>(contact.totalNodes),
                static_cast<int>(contact.interfaces.size()),
                contact.weightsPositive ? ""
                                        : "; faces with non-positive nodal weights: accepted only "
                                          "while contact is closed everywhere"));
  return contact;
}

bool sameOnAllRanks(MPI_Comm comm, const std::vector<unsigned char>& a,
                    const std::vector<unsigned char>& b) {
  int same = a == b;
  check(MPI_Allreduce(MPI_IN_PLACE, &same, 1, MPI_INT, MPI_LAND, comm));
  return same;
}

/// The associated system of the active set in force; made anew when the set changes.
class CurrentSystem {
 public:
  CurrentSystem(const Analysis& analysis) : analysis_(analysis) {}
  const contact::AssociatedSystem& of(const std::vector<unsigned char>& closed) {
    if (!system_ || !sameOnAllRanks(analysis_.mesh->comm, system_->closed(), closed)) {
      system_.reset();  // the old factorisation's memory first
      Stage stage(analysis_.mesh->comm, "contact");
      system_ =
          std::make_unique<contact::AssociatedSystem>(analysis_.bodies, analysis_.contact, closed);
      stage.finish(formatted("%d unknowns with %d of %d contact nodes closed",
                             static_cast<int>(system_->size()),
                             static_cast<int>(analysis_.contact.totalNodes - system_->openNodes()),
                             static_cast<int>(analysis_.contact.totalNodes)));
    }
    return *system_;
  }

 private:
  const Analysis& analysis_;
  std::unique_ptr<contact::AssociatedSystem> system_;
};

/// Steady sliding at every steady point, each started from the active set of a neighbour.
std::vector<steady::Solution> steadySweep(const Analysis& analysis, CurrentSystem& system) {
  const steady::Problem problem(*analysis.mesh, analysis.bodies, analysis.contact);
  const std::vector<unsigned char> bonded(analysis.contact.nodes.size(), 1);
  std::vector<std::vector<unsigned char>>
      closed;  // [steady point] its active set, or the one tried where there is no solution
  std::vector<steady::Solution> solutions;
  for (const auto& at : analysis.sweep.steadyPoints()) {
    const auto neighbour = analysis.sweep.earlierNeighbour(solutions.size());
    closed.push_back(neighbour ? closed[*neighbour] : bonded);
    const auto& current = system.of(closed.back());
    current.solver();
    Stage stage(analysis.mesh->comm, "steady");
    solutions.push_back(problem.solve(at, current));
    const auto& solution = solutions.back();
    stage.finish(formatted(
        "%s: %s after %d iterations, %d of %d nodes open, smallest pressure %.4g, residual %.0e, "
        "imbalance %.0e",
        sweep::parameterText(at).c_str(), solution.reason.c_str(), solution.iterations,
        static_cast<int>(solution.openNodes), static_cast<int>(analysis.contact.totalNodes),
        solution.smallestPressure, solution.residual, solution.imbalance));
    if (solution.converged)
      linalg::requireFinite(solution.displacement, "steady sliding at " + sweep::parameterText(at));
    if (solution.converged)
      closed.back() = solution.closed;
    else
      complain(analysis.mesh->comm,
               formatted("no steady sliding solution found at %s: %s",
                         sweep::parameterText(at).c_str(), solution.reason.c_str()));
  }
  return solutions;
}

/// Collective. Error where a matrix or a load, times what the sweep multiplies it by, is not a
/// number.
void requireFiniteSweep(const Analysis& analysis) {
  const auto& [frictions, speeds, pressures, dampings] = analysis.sweep;
  const double friction = std::max(1.0, frictions.back()), speed = std::max(1.0, speeds.back()),
               speed2 = speed * speed;
  const std::string swept = " times the factors of the sweep";
  linalg::requireFinite(analysis.bodies.stiffness, "the stiffness of the bodies" + swept, friction);
  linalg::requireFinite(analysis.bodies.mass, "the mass of the bodies" + swept, friction);
  linalg::requireFinite(analysis.bodies.damping, "the damping of the bodies" + swept,
                        friction * std::max(1.0, dampings.back()));
  linalg::requireFinite(analysis.bodies.gyroscopic, "the gyroscopic matrix" + swept,
                        friction * speed);
  linalg::requireFinite(analysis.bodies.rotationStiffness, "the rotation stiffness" + swept,
                        friction * speed2);
  linalg::requireFinite(analysis.bodies.load, "the loads" + swept,
                        std::max(pressures.back(), speed2));
  linalg::requireFinite(analysis.contact.offset, "the displacements held" + swept,
                        std::max(1.0, pressures.back()));
}

/// Collective. Error where the coefficient of a matrix, at an end of the sweep, makes something of
/// it that is not a number.
void requireFiniteSweep(const std::vector<matrices::NamedTerm>& terms, const sweep::Sweep& sweep) {
  for (const auto& [name, term] : terms)
    for (double friction : {sweep.frictions.front(), sweep.frictions.back()})
      for (double speed : {sweep.speeds.front(), sweep.speeds.back()})
        for (double damping : {sweep.dampings.front(), sweep.dampings.back()})
          linalg::requireFinite(term.matrix, "matrix '" + name + "' times its factors",
                                term.coefficient({friction, speed, 1, damping}));
}

/// Collective. Error for a sweep over a factor of nothing: all its points would be the same.
void rejectIdleFactors(const Analysis& analysis) {
  const auto given = [](const std::vector<double>& factors) {
    return factors != std::vector<double>{1};
  };
  if (given(analysis.sweep.dampings) && !analysis.bodies.damping && !flutter::modalDampingWanted())
    throw Error(
        "option -flutter_damping scales the damping of the bodies, and there is none: give "
        "-material_<group>_rayleigh_*, "
        "-material_<group>_loss_factor, -ground_<group>_damping or -flutter_modal_damping");
  if (!given(analysis.sweep.pressures)) return;
  OwnedVec pressures;
  check(VecDuplicate(analysis.bodies.load, pressures.out()));
  check(VecWAXPY(pressures, -1, analysis.bodies.centrifugal, analysis.bodies.load));
  PetscReal load = 0, displacement = 0;
  check(VecNorm(pressures, NORM_INFINITY, &load));
  check(VecNorm(analysis.contact.offset, NORM_INFINITY, &displacement));
  if (load == 0 && displacement == 0)
    throw Error(
        "option -flutter_pressure scales what presses, and nothing does: give "
        "-load_<group>_pressure, "
        "-constraint_<group>_displacement or -contact_<interface>_obstacle_displacement");
}

/// At each speed, or once where K and the slip are the same at all; loads do not matter.
std::vector<SpeedUniqueness> examineUniqueness(const Analysis& analysis) {
  std::vector<double> speeds = analysis.sweep.speeds;
  if (analysis.contact.slipIsGiven()) speeds.resize(1);
  std::vector<SpeedUniqueness> result;
  for (double speed : speeds) {
    Stage stage(analysis.mesh->comm, "steady");
    result.push_back({speed, steady::examine(analysis.bodies, analysis.contact, speed,
                                             analysis.sweep.frictions)});
    const auto& last = result.back().found.judgements.back();
    stage.finish(formatted("uniqueness at friction %g: %s (%s)", last.friction,
                           last.verdict.c_str(), last.reason.c_str()));
  }
  return result;
}

/// The terms of one point, and the change of its geometric stiffness from that of `reference`,
/// which is in the modes of the segment.
std::vector<pencil::Term> termsOf(const Analysis& analysis, const contact::AssociatedSystem& system,
                                  const steady::Solution& solution,
                                  const steady::Solution& reference, Mat prestress) {
  OwnedMat change;
  if (prestress && &solution != &reference) {
    change = elasticity::geometricStiffness(*analysis.mesh, solution.displacement);
    check(MatAXPY(change, -1, prestress, SAME_NONZERO_PATTERN));
  }
  return flutter::pointTerms(analysis.contact, system, solution, change);
}

/// Friction work of the shapes and, if wanted, the sensitivities of their eigenvalues.
void examineShapes(const Analysis& analysis, const contact::AssociatedSystem& system,
                   const steady::Solution& solution, const pencil::Pencil& pencil,
                   const sensitivity::StartSpace& start, flutter::Influences& influences,
                   pencil::FrictionPoint& point) {
  if (point.shapes.empty()) return;
  OwnedMat prestress;
  if (elasticity::prestressWanted())
    prestress = elasticity::geometricStiffness(*analysis.mesh, solution.displacement);
  for (auto& shape : point.shapes)
    shape.frictionWork = flutter::frictionWork(
        analysis.contact, analysis.bodies, solution, point.at, point.eigenvalues[shape.index].s,
        linalg::ComplexVector::copied(shape.real, shape.imaginary), prestress);
  if (!sensitivity::sensitivitiesWanted()) return;
  Stage stage(analysis.mesh->comm, "flutter");
  influences.derive(point, pencil, {point.at, system, solution, prestress}, start);
  double error = 0;
  for (const auto& sensitivity : point.sensitivities)
    error = std::max(error, sensitivity.leftBackwardError);
  stage.finish(formatted("%s: sensitivities of %d eigenvalues, worst left backward error %.1e",
                         sweep::parameterText(point.at).c_str(),
                         static_cast<int>(point.sensitivities.size()), error));
}

/// The terms of any point with the active set of `reference`; none: it has another one, or no
/// steady state.
class PointSource {
 public:
  PointSource(const Analysis& analysis, const contact::AssociatedSystem& system,
              const steady::Solution& reference, Mat prestress, CurrentSystem& current)
      : analysis_(analysis),
        system_(system),
        reference_(reference),
        prestress_(prestress),
        current_(current) {}

  std::optional<std::vector<pencil::Term>> operator()(sweep::Parameters at) {
    at.damping = 1;
    const auto known = std::find_if(analysis_.steady.begin(), analysis_.steady.end(),
                                    [&](const auto& solution) { return solution.at == at; });
    if (known != analysis_.steady.end()) return of(*known);
    if (!problem_)
      problem_ =
          std::make_unique<steady::Problem>(*analysis_.mesh, analysis_.bodies, analysis_.contact);
    return of(problem_->solve(at, current_.of(reference_.closed)));
  }

 private:
  std::optional<std::vector<pencil::Term>> of(const steady::Solution& solution) const {
    if (!solution.converged ||
        !sameOnAllRanks(analysis_.mesh->comm, solution.closed, reference_.closed))
      return {};
    return termsOf(analysis_, system_, solution, reference_, prestress_);
  }
  const Analysis& analysis_;
  const contact::AssociatedSystem& system_;
  const steady::Solution& reference_;
  Mat prestress_;
  CurrentSystem& current_;
  std::unique_ptr<steady::Problem> problem_;
};

/// Modes of one active set, then flutter at the points from `first` to `last` that share it.
ModalSegment flutterSegment(const Analysis& analysis, std::size_t first, std::size_t last,
                            CurrentSystem& current, flutter::Influences& influences,
                            double& floor) {
  const auto& closed = analysis.steady[first].closed;
  OwnedMat prestress;
  std::unique_ptr<contact::AssociatedSystem> stressed;
  if (elasticity::prestressWanted()) {
    prestress = elasticity::geometricStiffness(*analysis.mesh, analysis.steady[first].displacement);
    stressed = std::make_unique<contact::AssociatedSystem>(analysis.bodies, analysis.contact,
                                                           closed, prestress);
  }
  const contact::AssociatedSystem& system = stressed ? *stressed : current.of(closed);
  SegmentProblem problem{system.k0(),
                         system.m0(),
                         [&] { return system.solver(); },
                         system.transformation().trial,
                         modes::wantedCount(),
                         {},
                         {},
                         {},
                         {}};
  for (std::size_t i = first; i < last; ++i) problem.steadyPoints.push_back(analysis.steady[i].at);
  problem.termsAt = [&](std::size_t i) {
    return termsOf(analysis, system, analysis.steady[first + i], analysis.steady[first], prestress);
  };
  problem.examine = [&](std::size_t i, const pencil::Pencil& pencil,
                        const sensitivity::StartSpace& start, pencil::FrictionPoint& point) {
    examineShapes(analysis, system, analysis.steady[first + i], pencil, start, influences, point);
  };
  pencil::Pencil pencil = flutter::affineTerms(analysis.contact, system);
  // Terms of their own are absent at friction 0 alone: the last point, of the largest friction, has
  // them if any point has.
  if (matrices::exportWanted())
    matrices::exportPencil(pencil.with(problem.termsAt(last - first - 1)), analysis.sweep,
                           last - first);
  PointSource source(analysis, system, analysis.steady[first], prestress, current);
  problem.termsOf = [&](const sweep::Parameters& at) { return source(at); };
  ModalSegment segment = solveSegment(problem, std::move(pencil), analysis.sweep.dampings, floor);
  segment.openNodes = system.openNodes();
  return segment;
}

/// Collective. Error for a sweep over a parameter that no matrix comes with: all its points would
/// be the same.
void rejectIdleParameters(const std::vector<matrices::NamedTerm>& terms,
                          const sweep::Sweep& sweep) {
  const auto require = [&](const std::vector<double>& values, const std::string& name,
                           auto exponent) {
    if (values.size() > 1 && std::none_of(terms.begin(), terms.end(), [&](const auto& named) {
          return exponent(named.term) != 0;
        }))
      throw Error("option -flutter_" + name + ": a sweep, but no matrix has -matrices_<name>_" +
                  name + "_exponent");
  };
  require(sweep.frictions, "friction",
          [](const pencil::Term& term) { return term.frictionExponent; });
  require(sweep.speeds, "speed", [](const pencil::Term& term) { return term.speedExponent; });
  if (!flutter::modalDampingWanted())
    require(sweep.dampings, "damping",
            [](const pencil::Term& term) { return term.dampingExponent; });
  if (sweep.pressures != std::vector<double>{1})
    throw Error("option -flutter_pressure: no matrix from a file depends on the pressure");
}

/// [4.15] with matrices from files: there is neither contact nor steady state.
Analysis analyseMatrices(Analysis analysis) {
  const MPI_Comm comm = analysis.comm;
  auto named = readMatrices(comm, analysis.sweep);
  Stage stage(comm, "matrices");
  const matrices::AssociatedSystem system(named);
  stage.finish(formatted(
      "%d unknowns%s", static_cast<int>(system.size()),
      system.asymmetry() > 0
          ? formatted("; stiffness without friction unsymmetric by %.1e: free modes of its "
                      "symmetric part",
                      system.asymmetry())
                .c_str()
          : ""));
  std::vector<pencil::Term> terms;
  for (auto& item : named) terms.push_back(std::move(item.term));
  pencil::Pencil pencil(std::move(terms));
  const auto points = analysis.sweep.steadyPoints();
  if (matrices::exportWanted()) matrices::exportPencil(pencil, analysis.sweep, points.size());
  OwnedMat identity;
  PetscInt local = 0;
  check(MatGetLocalSize(system.k0(), &local, nullptr));
  check(MatCreateConstantDiagonal(comm, local, local, PETSC_DETERMINE, PETSC_DETERMINE, 1,
                                  identity.out()));
  const int modes = static_cast<int>(std::min<PetscInt>(modes::wantedCount(), system.size()));
  SegmentProblem problem{system.k0(), system.m0(), [&] { return system.solver(); },
                         identity,    modes,       points,
                         {},          {},          {}};
  problem.examine = [&](std::size_t, const pencil::Pencil& at, const sensitivity::StartSpace& start,
                        pencil::FrictionPoint& point) {
    if (sensitivity::sensitivitiesWanted())
      sensitivity::deriveParameters(point, at, start, system.solver(), system.m0());
  };
  analysis.segments.push_back(solveSegment(problem, std::move(pencil), analysis.sweep.dampings,
                                           analysis.modesFloorSeconds));
  return analysis;
}

}  // namespace

mesh::Request meshRequest() {
  mesh::Request request;
  request.bodies = elasticity::materialGroups();
  request.moving = elasticity::movingBodies();
  request.nodeGroups = contact::constrainedGroups();
  for (const auto& group : elasticity::groundedGroups()) request.nodeGroups.push_back(group);
  request.surfaces = elasticity::loadedSurfaces();
  request.interfaces = contact::readInterfaces();
  request.periodic = contact::periodicPairs();
  request.howToGiveMaterials = elasticity::howToGiveMaterials();
  request.motionOptions = elasticity::motionOptions();
  return request;
}

bool Analysis::converged() const {
  return std::all_of(steady.begin(), steady.end(),
                     [](const auto& solution) { return solution.converged; });
}

const pencil::FrictionPoint* Analysis::pointAt(const sweep::Parameters& at) const {
  for (const auto& segment : segments)
    for (const auto& point : segment.points)
      if (point.at == at) return &point;
  return nullptr;
}

void checkOptions() {
  rejectUnknownOptions();
  direct::rejectIdleSolverOptions();
  if (direct::directWanted() && flutter::modalDampingWanted())
    throw Error(
        "option -flutter_modal_damping: damping of the free modes needs the modes of "
        "-flutter_method reduced");
  sweep::readSweep();
  if (!matrices::wanted()) meshRequest();
}

std::vector<matrices::NamedTerm> readMatrices(MPI_Comm comm, const sweep::Sweep& sweep) {
  Stage stage(comm, "matrices");
  auto named = matrices::readTerms(comm);
  rejectIdleParameters(named, sweep);
  requireFiniteSweep(named, sweep);
  std::vector<std::string> files;
  for (const auto& item : named)
    files.push_back(resolvedOptions().at("matrices_" + item.name + "_file"));
  stage.finish(formatted("%d matrices: %s", static_cast<int>(named.size()), joined(files).c_str()));
  return named;
}

Analysis prepare(MPI_Comm comm) {
  Analysis analysis;
  analysis.comm = comm;
  const bool ofMesh = !matrices::wanted();
  analysis.sweep = sweep::readSweep();
  if (!direct::directWanted()) sweep::warnOfLongSweep(comm, analysis.sweep, modes::wantedCount());
  if (!ofMesh) return analysis;
  analysis.mesh = std::make_unique<mesh::Mesh>(readMesh(comm));
  analysis.bodies = assembleBodies(*analysis.mesh);
  analysis.contact = buildContact(*analysis.mesh, analysis.bodies);
  requireFiniteSweep(analysis);
  rejectIdleFactors(analysis);
  return analysis;
}

Analysis analyse(MPI_Comm comm) {
  Analysis analysis = prepare(comm);
  if (!analysis.mesh) return analyseMatrices(std::move(analysis));
  CurrentSystem system(analysis);
  analysis.steady = steadySweep(analysis, system);
  if (analysis.contact.totalNodes > 0 && steady::uniquenessWanted())
    analysis.uniqueness = examineUniqueness(analysis);
  flutter::Influences influences(*analysis.mesh, analysis.bodies, analysis.contact);
  for (std::size_t first = 0, last = 0; first < analysis.steady.size(); first = last) {
    last = first + 1;
    const auto& start = analysis.steady[first];
    if (!start.converged) continue;
    while (last < analysis.steady.size() && analysis.steady[last].converged &&
           sameOnAllRanks(comm, analysis.steady[last].closed, start.closed))
      ++last;
    analysis.segments.push_back(
        flutterSegment(analysis, first, last, system, influences, analysis.modesFloorSeconds));
  }
  return analysis;
}

}  // namespace squeal::analysis
