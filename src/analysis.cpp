#include "analysis.hpp"

#include <algorithm>
#include <cmath>

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

contact::Contact buildContact(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, const std::vector<double>& frictions) {
  Stage stage(mesh.comm, "contact");
  contact::Contact contact = contact::build(mesh, bodies);
  if (std::any_of(frictions.begin(), frictions.end(), [](double f) { return f > 0; })) contact::requireSlip(contact);
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

/// Steady sliding at every friction, each started from the active set of the one before.
std::vector<steady::Solution> steadySweep(const Analysis& analysis, const std::vector<double>& frictions, CurrentSystem& system) {
  const steady::Problem problem(*analysis.mesh, analysis.bodies, analysis.contact);
  std::vector<unsigned char> closed(analysis.contact.nodes.size(), 1);  // bonded
  std::vector<steady::Solution> solutions;
  for (double friction : frictions) {
    const auto& current = system.of(closed);
    current.solver();
    Stage stage(analysis.mesh->comm, "steady");
    solutions.push_back(problem.solve(friction, current));
    const auto& solution = solutions.back();
    stage.finish(formatted("friction %g: %s after %d iterations, %d of %d nodes open, smallest pressure %.4g, imbalance %.0e",
                           friction, solution.reason.c_str(), solution.iterations, static_cast<int>(solution.openNodes),
                           static_cast<int>(analysis.contact.totalNodes), solution.smallestPressure, solution.imbalance));
    if (solution.converged)
      closed = solution.closed;
    else
      complain(analysis.mesh->comm,
               formatted("no steady sliding solution found at -flutter_friction %g: %s", friction, solution.reason.c_str()));
  }
  return solutions;
}

std::vector<OwnedVec> nodalShapes(const modes::Modes& modes, const contact::AssociatedSystem& system) {
  std::vector<OwnedVec> shapes;
  const int count = std::min(modesShown.get(), static_cast<int>(modes.angularFrequency.size()));
  for (int i = 0; i < count; ++i) {
    Vec d = nullptr;
    OwnedVec u;
    PetscReal largest = 0;
    check(MatCreateVecs(system.matrices().transformation.trial, nullptr, u.out()));
    check(BVGetColumn(modes.vectors, i, &d));
    check(MatMult(system.matrices().transformation.trial, d, u));
    check(BVRestoreColumn(modes.vectors, i, &d));
    check(VecNorm(u, NORM_INFINITY, &largest));
    check(VecScale(u, 1 / largest));
    shapes.push_back(std::move(u));
  }
  return shapes;
}

/// Modes of one active set, then flutter at the frictions from `first` to `last` that share it.
ModalSegment flutterSegment(const Analysis& analysis, std::size_t first, std::size_t last, const contact::AssociatedSystem& system,
                            double& floor) {
  ModalSegment segment;
  segment.openNodes = system.openNodes();
  segment.unknowns = system.size();
  const flutter::Pencil pencil = flutter::approximationA(system);
  const bool direct = flutter::directWanted();
  if (direct) contact::rejectUnusedSolverOptions();
  std::unique_ptr<flutter::ReducedProblem> reduced;
  if (!direct) {
    segment.modes = modes::compute(system);
    if (benchmarkWanted.get()) floor = modes::floorSeconds(system);
    segment.shapes = nodalShapes(segment.modes, system);
    Stage stage(analysis.mesh->comm, "flutter");
    reduced = std::make_unique<flutter::ReducedProblem>(pencil, system, segment.modes);
    stage.finish("friction operators projected on the modes");
  }
  // The largest friction first: its corrections nearly suffice for the others.
  std::vector<std::size_t> order{last - 1};
  for (std::size_t i = first; i + 1 < last; ++i) order.push_back(i);
  segment.points.resize(last - first);
  for (std::size_t i : order) {
    const double friction = analysis.steady[i].friction;
    Stage stage(analysis.mesh->comm, "flutter");
    const Mat trial = system.matrices().transformation.trial;
    auto& point = segment.points[i - first];
    point = direct ? flutter::solveDirect(pencil, friction, trial) : reduced->solve(friction, trial);
    stage.finish(formatted(
        "friction %g: %d of %d eigenvalues unstable%s, worst backward error %.1e%s", friction, point.unstableCount(),
        point.bandCount(), point.bandTop > 0 ? formatted(" to %.4g Hz", point.bandTop / (2 * M_PI)).c_str() : "",
        point.worstBackwardError(), direct ? "" : formatted(", basis of %d", static_cast<int>(reduced->basisSize())).c_str()));
  }
  return segment;
}

}  // namespace

mesh::Request meshRequest() {
  mesh::Request request;
  request.bodies = elasticity::materialGroups();
  request.moving = elasticity::movingBodies();
  request.nodeGroups = contact::constrainedGroups();
  request.surfaces = elasticity::loadedSurfaces();
  request.interfaces = contact::readInterfaces();
  request.periodic = contact::periodicPairs();
  return request;
}

bool Analysis::converged() const {
  return std::all_of(steady.begin(), steady.end(), [](const auto& solution) { return solution.converged; });
}

Analysis analyse(MPI_Comm comm) {
  rejectUnknownOptions();
  flutter::rejectIdleSolverOptions();
  const auto frictions = flutter::frictions();
  Analysis analysis;
  analysis.mesh = std::make_unique<mesh::Mesh>(readMesh(comm));
  analysis.bodies = assembleBodies(*analysis.mesh);
  analysis.contact = buildContact(*analysis.mesh, analysis.bodies, frictions);
  CurrentSystem system(analysis);
  analysis.steady = steadySweep(analysis, frictions, system);
  for (std::size_t first = 0, last = 0; first < frictions.size(); first = last) {
    last = first + 1;
    const auto& start = analysis.steady[first];
    if (!start.converged) continue;
    while (last < frictions.size() && analysis.steady[last].converged &&
           sameOnAllRanks(comm, analysis.steady[last].closed, start.closed))
      ++last;
    analysis.segments.push_back(flutterSegment(analysis, first, last, system.of(start.closed), analysis.modesFloorSeconds));
  }
  return analysis;
}

}  // namespace squeal
