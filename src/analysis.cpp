#include "analysis.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "flutter/reduced.hpp"
#include "modes/benchmark.hpp"
#include "petsc/options.hpp"
#include "petsc/stages.hpp"
#include "petsc/text.hpp"

namespace squeal {
namespace {

const IntegerOption modesShown("report", "report_modes", 10, 0, "number of free modes written as fields");
const FlagOption benchmarkWanted("modes", "modes_benchmark", false,
                                 "time one factorisation and 400 solves in blocks of 32, the floor of the stage");

mesh::Mesh readMesh(MPI_Comm comm) {
  const mesh::Request request = meshRequest();
  Stage stage(comm, "mesh");
  mesh::Mesh mesh = mesh::read(comm, request);
  stage.finish(formatted("%d nodes, %d cells, %d bodies in %d connected parts", static_cast<int>(mesh.totalNodes),
                         static_cast<int>(mesh.totalCells), static_cast<int>(mesh.bodies.size()), mesh.parts));
  return mesh;
}

elasticity::Bodies assembleBodies(const mesh::Mesh& mesh) {
  Stage stage(mesh.comm, "elasticity");
  elasticity::Bodies bodies = elasticity::assemble(mesh);
  stage.finish(formatted("stiffness, mass and loads on %d displacements", static_cast<int>(mesh.dimension * mesh.totalNodes)));
  return bodies;
}

contact::Contact buildContact(const mesh::Mesh& mesh, const elasticity::Bodies& bodies) {
  Stage stage(mesh.comm, "contact");
  contact::Contact contact = contact::build(mesh, bodies);
  stage.finish(formatted(
      "%d contact nodes on %d interfaces%s", static_cast<int>(contact.totalNodes), static_cast<int>(contact.interfaces.size()),
      contact.weightsPositive ? "" : "; faces with non-positive nodal weights: accepted only while contact is closed everywhere"));
  return contact;
}

bool sameOnAllRanks(MPI_Comm comm, const std::vector<unsigned char>& a, const std::vector<unsigned char>& b) {
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
      system_ = std::make_unique<contact::AssociatedSystem>(analysis_.bodies, analysis_.contact, closed);
      stage.finish(formatted("%d unknowns with %d of %d contact nodes closed", static_cast<int>(system_->size()),
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
  std::vector<std::vector<unsigned char>> closed;  // [steady point] its active set, or the one tried where there is no solution
  std::vector<steady::Solution> solutions;
  for (const auto& at : analysis.sweep.steadyPoints()) {
    const auto neighbour = analysis.sweep.earlierNeighbour(solutions.size());
    closed.push_back(neighbour ? closed[*neighbour] : bonded);
    const auto& current = system.of(closed.back());
    current.solver();
    Stage stage(analysis.mesh->comm, "steady");
    solutions.push_back(problem.solve(at, current));
    const auto& solution = solutions.back();
    stage.finish(formatted("%s: %s after %d iterations, %d of %d nodes open, smallest pressure %.4g, imbalance %.0e",
                           parameterText(at).c_str(), solution.reason.c_str(), solution.iterations,
                           static_cast<int>(solution.openNodes), static_cast<int>(analysis.contact.totalNodes),
                           solution.smallestPressure, solution.imbalance));
    if (solution.converged)
      closed.back() = solution.closed;
    else
      complain(analysis.mesh->comm,
               formatted("no steady sliding solution found at %s: %s", parameterText(at).c_str(), solution.reason.c_str()));
  }
  return solutions;
}

/// Collective. Error for a sweep over a factor of nothing: all its points would be the same.
void rejectIdleFactors(const Analysis& analysis) {
  const auto given = [](const std::vector<double>& factors) { return factors != std::vector<double>{1}; };
  if (given(analysis.sweep.dampings) && !analysis.bodies.damping && !flutter::modalDampingWanted())
    throw Error(
        "option -flutter_damping scales the damping of the bodies, and there is none: give -material_<group>_rayleigh_*, "
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
        "option -flutter_pressure scales what presses, and nothing does: give -load_<group>_pressure, "
        "-constraint_<group>_displacement or -contact_<interface>_obstacle_displacement");
}

/// At each speed, or once where K and the slip are the same at all; loads do not matter.
std::vector<SpeedUniqueness> examineUniqueness(const Analysis& analysis) {
  std::vector<double> speeds = analysis.sweep.speeds;
  if (analysis.contact.slipIsGiven()) speeds.resize(1);
  std::vector<SpeedUniqueness> result;
  for (double speed : speeds) {
    Stage stage(analysis.mesh->comm, "steady");
    result.push_back({speed, steady::examine(analysis.bodies, analysis.contact, speed, analysis.sweep.frictions)});
    const auto& last = result.back().found.judgements.back();
    stage.finish(formatted("uniqueness at friction %g: %s (%s)", last.friction, last.verdict.c_str(), last.reason.c_str()));
  }
  return result;
}

std::vector<OwnedVec> nodalShapes(const modes::Modes& modes, const contact::AssociatedSystem& system) {
  std::vector<OwnedVec> shapes;
  const int count = std::min(modesShown.get(), static_cast<int>(modes.angularFrequency.size()));
  for (int i = 0; i < count; ++i) {
    Vec d = nullptr;
    OwnedVec u;
    PetscReal largest = 0;
    check(MatCreateVecs(system.transformation().trial, nullptr, u.out()));
    check(BVGetColumn(modes.vectors, i, &d));
    check(MatMult(system.transformation().trial, d, u));
    check(BVRestoreColumn(modes.vectors, i, &d));
    check(VecNorm(u, NORM_INFINITY, &largest));
    check(VecScale(u, 1 / largest));
    shapes.push_back(std::move(u));
  }
  return shapes;
}

/// The terms of one point, and the change of its geometric stiffness from that of `reference`, which is in the modes of the segment.
std::vector<flutter::Term> termsOf(const Analysis& analysis, const contact::AssociatedSystem& system,
                                   const steady::Solution& solution, const steady::Solution& reference, Mat prestress) {
  OwnedMat change;
  if (prestress && &solution != &reference) {
    change = elasticity::geometricStiffness(*analysis.mesh, solution.displacement);
    check(MatAXPY(change, -1, prestress, SAME_NONZERO_PATTERN));
  }
  return flutter::pointTerms(analysis.contact, system, solution, change);
}

std::string pointText(const flutter::FrictionPoint& point) {
  std::string text = formatted("%s: %d of %d eigenvalues unstable", parameterText(point.at).c_str(), point.unstableCount(),
                               static_cast<int>(point.eigenvalues.size()));
  if (point.bandTop > 0) text += formatted(" to %.4g Hz", point.bandTop / (2 * M_PI));
  text += formatted(", worst backward error %.1e", point.worstBackwardError());
  if (point.tolerance > 0) text += formatted(", estimated error %.1e", point.worstErrorEstimate());
  return text;
}

/// The problem of any point with the active set of `reference`; none: it has another one, or no steady state.
class PointSource {
 public:
  PointSource(const Analysis& analysis, const contact::AssociatedSystem& system, const steady::Solution& reference, Mat prestress,
              const flutter::Pencil& pencil, CurrentSystem& current, bool affine)
      : analysis_(analysis),
        system_(system),
        reference_(reference),
        prestress_(prestress),
        pencil_(pencil),
        current_(current),
        affine_(affine) {}

  std::optional<flutter::PointProblem> operator()(const Parameters& at) {
    if (affine_) return flutter::PointProblem{at, pencil_.with({})};
    Parameters steadyAt = at;
    steadyAt.damping = 1;
    const auto known = std::find_if(analysis_.steady.begin(), analysis_.steady.end(),
                                    [&](const auto& solution) { return solution.at == steadyAt; });
    if (known != analysis_.steady.end()) return of(*known, at);
    if (!problem_) problem_ = std::make_unique<steady::Problem>(*analysis_.mesh, analysis_.bodies, analysis_.contact);
    return of(problem_->solve(steadyAt, current_.of(reference_.closed)), at);
  }

 private:
  std::optional<flutter::PointProblem> of(const steady::Solution& solution, const Parameters& at) const {
    if (!solution.converged || !sameOnAllRanks(analysis_.mesh->comm, solution.closed, reference_.closed)) return {};
    return flutter::PointProblem{at, pencil_.with(termsOf(analysis_, system_, solution, reference_, prestress_))};
  }
  const Analysis& analysis_;
  const contact::AssociatedSystem& system_;
  const steady::Solution& reference_;
  Mat prestress_;
  const flutter::Pencil& pencil_;
  CurrentSystem& current_;
  bool affine_;  // no point has terms of its own
  std::unique_ptr<steady::Problem> problem_;
};

/// Followed eigenvalues and critical frictions of the points of a segment.
void followPoints(const Analysis& analysis, ModalSegment& segment, flutter::ReducedProblem& reduced,
                  const flutter::ProblemSource& problemAt) {
  const MPI_Comm comm = analysis.mesh->comm;
  Stage stage(comm, "track");
  segment.followed = flutter::followSweep(reduced, segment.points, segment.modes, comm, problemAt);
  std::size_t branches = 0, stations = 0, criticals = 0;
  for (const auto& followed : segment.followed) {
    branches += static_cast<std::size_t>(followed.branches.count);
    stations += followed.branches.stations.size();
    criticals += followed.criticals.size();
  }
  stage.finish(formatted("%zu branches followed over %zu frictions, %zu critical frictions, basis of %d", branches, stations,
                         criticals, static_cast<int>(reduced.basisSize())));
}

/// Modes of one active set, then flutter at the points from `first` to `last` that share it.
ModalSegment flutterSegment(const Analysis& analysis, std::size_t first, std::size_t last, CurrentSystem& current, double& floor) {
  const auto& closed = analysis.steady[first].closed;
  OwnedMat prestress;
  std::unique_ptr<contact::AssociatedSystem> stressed;
  if (elasticity::prestressWanted()) {
    prestress = elasticity::geometricStiffness(*analysis.mesh, analysis.steady[first].displacement);
    stressed = std::make_unique<contact::AssociatedSystem>(analysis.bodies, analysis.contact, closed, prestress);
  }
  const contact::AssociatedSystem& system = stressed ? *stressed : current.of(closed);
  const Mat trial = system.transformation().trial;
  ModalSegment segment;
  segment.openNodes = system.openNodes();
  segment.unknowns = system.size();
  flutter::Pencil pencil = flutter::affineTerms(analysis.contact, system);
  const bool direct = flutter::directWanted();
  if (direct) contact::rejectUnusedSolverOptions();
  std::unique_ptr<flutter::ReducedProblem> reduced;
  if (!direct) {
    segment.modes = modes::compute(system);
    if (benchmarkWanted.get()) floor = modes::floorSeconds(system);
    segment.shapes = nodalShapes(segment.modes, system);
    pencil.add(flutter::modalDamping(segment.modes, system.m0()));
    Stage stage(analysis.mesh->comm, "flutter");
    reduced = std::make_unique<flutter::ReducedProblem>(pencil, system.k0(), system.solver(), segment.modes);
    stage.finish(formatted("basis of %d: free modes and static responses to friction", static_cast<int>(reduced->basisSize())));
  }
  std::vector<Parameters> points;
  for (double damping : analysis.sweep.dampings)
    for (std::size_t i = first; i < last; ++i) {
      points.push_back(analysis.steady[i].at);
      points.back().damping = damping;
    }
  segment.points.resize(points.size());
  bool affine = true;
  for (const auto& batch : flutter::batches(points)) {
    Stage stage(analysis.mesh->comm, "flutter");
    std::vector<flutter::PointProblem> problems;
    for (std::size_t i : batch) {
      const auto& solution = analysis.steady[first + i % (last - first)];
      problems.push_back({points[i], pencil.with(termsOf(analysis, system, solution, analysis.steady[first], prestress))});
      affine = affine && problems.back().pencil.terms().size() == pencil.terms().size();
    }
    std::vector<flutter::FrictionPoint> solved;
    if (reduced) solved = reduced->solve(problems, trial);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      auto& point = segment.points[batch[i]];
      point = reduced ? std::move(solved[i]) : flutter::solveDirect(problems[i].pencil, problems[i].at, trial);
      stage.say(pointText(point));
    }
    stage.finish(
        formatted("%d points", static_cast<int>(batch.size())) +
        (reduced ? formatted(", basis of %d, %ld solves", static_cast<int>(reduced->basisSize()), reduced->basis().solves()) : ""));
  }
  if (reduced && flutter::trackWanted()) {
    PointSource source(analysis, system, analysis.steady[first], prestress, pencil, current, affine);
    followPoints(analysis, segment, *reduced, [&](const Parameters& at) { return source(at); });
  }
  if (reduced) segment.solves = reduced->basis().solves();
  return segment;
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
  return request;
}

bool Analysis::converged() const {
  return std::all_of(steady.begin(), steady.end(), [](const auto& solution) { return solution.converged; });
}

const flutter::FrictionPoint* Analysis::pointAt(const Parameters& at) const {
  for (const auto& segment : segments)
    for (const auto& point : segment.points)
      if (point.at == at) return &point;
  return nullptr;
}

Analysis analyse(MPI_Comm comm) {
  rejectUnknownOptions();
  flutter::rejectIdleSolverOptions();
  Analysis analysis;
  analysis.sweep = flutter::readSweep();
  analysis.mesh = std::make_unique<mesh::Mesh>(readMesh(comm));
  analysis.bodies = assembleBodies(*analysis.mesh);
  analysis.contact = buildContact(*analysis.mesh, analysis.bodies);
  rejectIdleFactors(analysis);
  CurrentSystem system(analysis);
  analysis.steady = steadySweep(analysis, system);
  if (analysis.contact.totalNodes > 0 && steady::uniquenessWanted()) analysis.uniqueness = examineUniqueness(analysis);
  for (std::size_t first = 0, last = 0; first < analysis.steady.size(); first = last) {
    last = first + 1;
    const auto& start = analysis.steady[first];
    if (!start.converged) continue;
    while (last < analysis.steady.size() && analysis.steady[last].converged &&
           sameOnAllRanks(comm, analysis.steady[last].closed, start.closed))
      ++last;
    analysis.segments.push_back(flutterSegment(analysis, first, last, system, analysis.modesFloorSeconds));
  }
  return analysis;
}

}  // namespace squeal
