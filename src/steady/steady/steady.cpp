// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/steady.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/contact/build.hpp"
#include "model/contact/hourglass.hpp"
#include "model/contact/loose.hpp"
#include "model/contact/response.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "steady/steady/complementarity.hpp"
#include "steady/steady/nodal_forces.hpp"
#include "steady/steady/resultants.hpp"
#include "steady/steady/separation.hpp"

namespace squeal::steady {
namespace {

/// The largest relative residual of an accepted solution.
constexpr double meaningful = 1e-6;
/// The largest number of revisions of sticking nodes; a few are usual.
constexpr int mostRevisions = 200;

}  // namespace

contact::ActiveSet activeSet(const Solution& solution) {
  return {solution.closed, solution.sticking.free()};
}

Problem::Problem(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                 const contact::Contact& contact)
    : Problem(mesh, bodies, contact, Sticking::allHeld(contact)) {}

Problem::Problem(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                 const contact::Contact& contact, Sticking sticking)
    : mesh_(mesh),
      bodies_(bodies),
      contact_(contact),
      all_(contact.interfaces.nodes.size(), 1),
      sticking_(std::move(sticking)),
      transformation_(contact.transformation(
          {contact::Mask(contact.interfaces.nodes.size(), 0), sticking_.free()})),
      diagonal_(elasticity::nodalVector(mesh)) {
  check(MatGetDiagonal(bodies.stiffness, diagonal_));
  int released = std::count(sticking_.holds.begin(), sticking_.holds.end(), Hold::released);
  released = mpi::max(mesh.comm, released);
  anyReleased_ = released > 0;
  if (!contact.sliding.convected) return;
  check(MatMatMult(contact.sliding.jump, transformation_.trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                   jumps_.out()));
  check(MatMatMult(contact.sliding.convected, transformation_.trial, MAT_INITIAL_MATRIX,
                   PETSC_DEFAULT, convected_.out()));
}

const contact::Projection& Problem::stiffness() const {
  if (!stiffness_) stiffness_ = contact::project(contact_, transformation_, bodies_.stiffness);
  return stiffness_;
}

OwnedVec Problem::load(const sweep::Parameters& at) const { return loadAt(mesh_, bodies_, at); }

OwnedVec Problem::springForces(double speed, Vec displacement) const {
  return steady::springForces(mesh_, bodies_, speed, displacement);
}

OwnedVec Problem::forces(const sweep::Parameters& at, Vec displacement) const {
  return supportForces(mesh_, bodies_, at, displacement);
}

std::vector<double> Problem::normalForces(Vec forces) const {
  const OwnedVec reactions = elasticity::nodalVector(mesh_);
  check(MatMult(contact_.sliding.reaction, forces, reactions));
  const ReadArray values(reactions);
  std::vector<double> normal;
  for (const auto& node : contact_.interfaces.nodes)
    normal.push_back(values[contact_.gapRow(node) - mesh_.dimension * mesh_.firstNode]);
  return normal;
}

/// Returns L(f)ᵀ r, computed as
///   Tᵀ (r + Jᵀ f φ E⁻ᵀ R_N τ).
OwnedVec Problem::test(const contact::Transformation& transformation, const contact::Mask& slides,
                       const sweep::Parameters& at, Vec forces,
                       const std::vector<contact::Slip>& slip) const {
  const OwnedVec friction = elasticity::nodalVector(mesh_), sum = elasticity::nodalVector(mesh_);
  const auto normal = contact_.nodalForce(normalForces(forces), slides);
  {
    const WriteArray values(friction);
    for (std::size_t i = 0; i < contact_.interfaces.nodes.size(); ++i)
      for (int d = 0; d < mesh_.dimension; ++d)
        values[mesh_.dimension * contact_.interfaces.nodes[i].node + d] =
            slip[i].friction(at.friction) * normal[i] * slip[i].direction[d];
  }
  check(MatMultTransposeAdd(contact_.sliding.jump, friction, forces, sum));
  OwnedVec result = rightVector(transformation.trial);
  check(MatMultTranspose(transformation.trial, sum, result));
  return result;
}

OwnedVec Problem::displacement(const contact::Transformation& transformation,
                               const sweep::Parameters& at, Vec x) const {
  OwnedVec u = elasticity::nodalVector(mesh_);
  check(MatMult(transformation.trial, x, u));
  check(VecAXPY(u, at.pressure, contact_.kinematics.offset));
  check(VecAXPY(u, 1, contact_.kinematics.gapOffset));
  return u;
}

void Problem::residual(const sweep::Parameters& at, Vec x, Vec result) const {
  const OwnedVec u = displacement(at, x);
  check(VecCopy(test(transformation_, all_, at, forces(at, u), slip(at.speed, u)), result));
}

/// Returns [M.14]
///   Tᵀ (K + v² K^R) T + Sᵀ N (K + v² K^R) T − v (J T)ᵀ B (D T)
/// with B of nodalResponse(). The last term, the rotation of the slip direction, exists only with
/// convective terms.
OwnedMat Problem::jacobian(const sweep::Parameters& at, Vec x) const {
  const OwnedVec u = displacement(at, x);
  const auto slip = this->slip(at.speed, u);
  const OwnedMat rows = slipRows(transformation_, slip, all_, at.friction);
  OwnedMat sum = stiffness().tested(rows);
  if (bodies_.rotationStiffness && !rotationStiffness_)
    rotationStiffness_ = contact::project(contact_, transformation_, bodies_.rotationStiffness);
  if (rotationStiffness_)
    check(MatAXPY(sum, at.speed * at.speed, rotationStiffness_.tested(rows),
                  DIFFERENT_NONZERO_PATTERN));
  if (contact_.sliding.convected) {
    const OwnedMat response = contact::nodalResponse(
        contact_, slip, contact_.nodalForce(normalForces(forces(at, u))), at.friction);
    OwnedMat change, turning;
    check(MatMatMult(response, convected_, MAT_INITIAL_MATRIX, PETSC_DEFAULT, change.out()));
    check(MatTransposeMatMult(jumps_, change, MAT_INITIAL_MATRIX, PETSC_DEFAULT, turning.out()));
    check(MatAXPY(sum, -at.speed, turning, DIFFERENT_NONZERO_PATTERN));
  }
  return sum;
}

OwnedMat Problem::slipRows(const contact::Transformation& transformation,
                           const std::vector<contact::Slip>& slip, const contact::Mask& slides,
                           double friction) const {
  return contact_.hasFriction(friction) || anyReleased_
             ? contact_.slipRowsAt(transformation, slip, slides, friction)
             : OwnedMat();
}

double Problem::rounding(Vec displacement, Vec loads) const {
  const OwnedVec magnitude = elasticity::nodalVector(mesh_);
  PetscReal springs = 0, forces = 0;
  check(VecPointwiseMult(magnitude, diagonal_, displacement));
  check(VecNorm(magnitude, NORM_2, &springs));
  if (loads) check(VecNorm(loads, NORM_2, &forces));
  return PETSC_MACHINE_EPSILON * (springs + forces);
}

/// Returns the slip, including that of released nodes.
std::vector<contact::Slip> Problem::slip(double speed, Vec displacement) const {
  return withReleased(contact_, contact_.slip(speed, displacement), sticking_);
}

/// Collective. Returns why a body is under-constrained with these holds; an empty text if none is.
std::string Problem::whyUnderConstrained(const Sticking& sticking) const {
  const auto mode = contact::rigidBodyMode(mesh_, contact_, bodies_, {.released = sticking.free()});
  return mode ? "body '" + mode->body + "' can move rigidly (" + mode->motion +
                    ") while nodes of sticking interfaces slide or are open; add another support"
              : "";
}

void Problem::requireSlip(const sweep::Parameters& at) const {
  contact::requireSlip(contact_, contact_.slip(at.speed, nullptr), all_, at.friction);
}

/// Collective. Rejects a solution whose open contact leaves a body under-constrained: its position
/// is arbitrary, and no stiffness matrix of this active set is positive definite.
void Problem::rejectUnderConstrained(Solution& solution) const {
  if (!solution.converged || solution.openNodes == 0) return;
  const contact::SupportingContact holding{.closed = solution.closed,
                                           .released = solution.sticking.free()};
  const auto mode = contact::rigidBodyMode(mesh_, contact_, bodies_, holding);
  const std::string hourglass =
      mode ? "" : contact::hourglassModes(mesh_, contact_, bodies_, holding);
  if (!mode && hourglass.empty()) return;
  solution.converged = false;
  solution.reason = hourglass;
  if (!mode) return;
  solution.reason = formatted(
      "body '%s' is under-constrained (%s): %" PetscInt_FMT " of %" PetscInt_FMT
      " contact nodes are open, and it has no other support; start the sweep at a friction that "
      "closes them, or support it with -constraint_<group>_clamped, -ground_<group>_stiffness or "
      "-bushing_<name>_stiffness",
      mode->body.c_str(), mode->motion.c_str(), solution.openNodes, contact_.interfaces.totalNodes);
}

Solution Problem::solve(const sweep::Parameters& at, const contact::CoupledSystem& system) const {
  requireSlip(at);
  const OwnedVec z = closedContact(at, system);
  Solution solution = solveFrom(at, z);
  while (auto next = nextHolds(solution)) {
    Solution better = Problem(mesh_, bodies_, contact_, std::move(*next)).solveFrom(at, z);
    better.revisions = solution.revisions + 1;
    better.iterations += solution.iterations;
    solution = std::move(better);
  }
  return solution;
}

std::optional<Sticking> Problem::nextHolds(Solution& solution) const {
  if (!solution.converged) return {};
  auto next = revised(contact_, solution);
  std::string failure = next ? whyUnderConstrained(*next) : pulledFriction(contact_, solution);
  if (next && failure.empty() && solution.revisions == mostRevisions)
    failure = formatted("the active set of sticking nodes has not settled after %d revisions",
                        mostRevisions);
  if (!next && failure.empty()) countReturned(contact_, solution);
  if (failure.empty()) return next;
  solution.converged = false;
  solution.reason = std::move(failure);
  return {};
}

/// Collective. Solves with the holds of this problem, from a start z, N entries, which becomes the
/// solution.
Solution Problem::solveFrom(const sweep::Parameters& at, Vec z) const {
  Solution solution;
  solution.at = at;
  OwnedVec x = rightVector(transformation_.trial);
  check(MatMultTranspose(transformation_.selection, z, x));
  const double left = complementarity(*this, x, solution);
  check(MatMult(transformation_.selection, x, z));
  conclude(x, left, solution);
  return solution;
}

void Problem::conclude(Vec x, double left, Solution& solution) const {
  solution.sticking = sticking_;
  if (solution.converged && solution.residual > meaningful) {
    solution.converged = false;
    solution.reason = formatted(
        "round-off leaves a relative residual of %.1e because displacements reach %.3g m: a body "
        "is under-constrained and needs stiffer springs, or a contact stiffness is so large that "
        "hard contact suits better",
        solution.residual, largestDisplacement(solution.at, x));
  }
  recover(x, left, solution);
  rejectUnderConstrained(solution);
  if (solution.reason.starts_with("DIVERGED"))
    solution.reason += heldByContactOnly(contact_, bodies_);
}

double Problem::largestDisplacement(const sweep::Parameters& at, Vec x) const {
  PetscReal largest = 0;
  check(VecNorm(displacement(at, x), NORM_INFINITY, &largest));
  return largest;
}

/// Collective. Solves the problem with the gaps of the active set held at zero, and returns the
/// solution z, N entries. Under approximation A it is linear. With convective terms, the matrix
/// omits K^R and the rotation of the slip direction, which are small; refinement then takes a few
/// more steps.
OwnedVec Problem::closedContact(const sweep::Parameters& at,
                                const contact::CoupledSystem& system) const {
  const auto& closed = system.transformation();
  const OwnedMat rows = slipRows(closed, slip(at.speed, nullptr), system.closed(), at.friction);
  const OwnedMat matrix = system.projections().stiffness.tested(rows);
  const auto residual = [&](Vec y) {
    const OwnedVec u = displacement(closed, at, y);
    return Residual{test(closed, system.closed(), at, forces(at, u), slip(at.speed, u)),
                    rounding(u, load(at))};
  };
  const OwnedVec y = rightVector(closed.trial);
  if (refine(innerSolver(matrix, system.solver()), residual, y).relative() >
      0.5) {  // near a friction without solution: the frictionless one to start from
    check(VecSet(y, 0));
    check(KSPSolve(system.solver(), residual(y).vector, y));
    check(VecScale(y, -1));
  }
  OwnedVec z = elasticity::nodalVector(mesh_);
  check(MatMult(closed.selection, y, z));
  return z;
}

void Problem::recover(Vec x, double noise, Solution& solution) const {
  solution.displacement = displacement(solution.at, x);
  const OwnedVec force = forces(solution.at, solution.displacement),
                 folded = elasticity::nodalVector(mesh_);
  check(MatMultTranspose(contact_.periodic, force,
                         folded));  // a contact node on a periodic boundary is loaded on both sides
  solution.slip = contact_.slip(solution.at.speed, solution.displacement);
  const auto normal = normalForces(force);

  PetscInt first = 0;
  check(VecGetOwnershipRange(x, &first, nullptr));
  const ReadArray values(x);
  std::vector<double> gaps;
  for (PetscInt column : transformation_.gapColumn) gaps.push_back(values[column - first]);
  gaps = contact_.nodalGap(gaps);
  double largest = 0;
  for (std::size_t i = 0; i < contact_.interfaces.nodes.size(); ++i) {
    const auto& node = contact_.interfaces.nodes[i];
    ContactState state;
    state.coefficient = values[transformation_.gapColumn[i] - first];
    state.gap = gaps[i];
    state.normalForce = normal[i];
    const auto& slip = solution.slip[i];
    for (std::size_t d = 0; d < 3; ++d)
      state.frictionForce[d] =
          -slip.friction(solution.at.friction) * state.normalForce * slip.direction[d];
    state.pressure = state.normalForce / node.area;
    largest = std::max(largest, std::abs(state.normalForce));
    solution.contact.push_back(state);
  }
  largest = mpi::max(mesh_.comm, largest);
  double smallest = INFINITY;
  // SNES leaves a force of the order of its tolerance at an open gap.
  solution.negligibleForce = std::max(1e-8 * largest, 10 * noise);
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& state = solution.contact[i];
    const bool closed =
        state.normalForce > solution.negligibleForce || !contact_.interfaces.nodes[i].separates;
    solution.closed.push_back(closed);
    solution.openNodes += !closed;
    smallest = std::min(smallest, state.pressure);
  }
  solution.openNodes = mpi::sum(mesh_.comm, solution.openNodes);
  smallest = mpi::min(mesh_.comm, smallest);
  solution.smallestPressure = contact_.interfaces.totalNodes ? smallest : 0;
  if (solution.converged)
    contact::requireSlip(contact_, solution.slip, solution.closed, solution.at.friction);

  const auto tangential =
      tangentialForces(contact_, solution, withReleased(contact_, solution.slip, sticking_), force);
  setStickingForces(contact_, tangential, solution);
  const auto onPads = forcesOnPads(contact_, solution, tangential);
  for (int i = 0; i < std::ssize(contact_.interfaces.names); ++i)
    if (!contact_.interfaces.options[i].isTied())
      solution.resultants.push_back(resultantOf(contact_, i, solution, onPads));
  solution.imbalance = imbalance(solution, folded, onPads);
}

/// Returns the worst imbalance of the forces on a connected part, relative to the sum of all
/// magnitudes, as a check of signs and solution. The forces are contact forces by the friction law,
/// support forces at held components, and loads.
double Problem::imbalance(const Solution& solution, Vec nodalForces,
                          const std::vector<Point>& onPads) const {
  const int dimension = mesh_.dimension;
  const OwnedVec balanced = contact_.movedFromLayers(nodalForces),
                 atNodes = elasticity::nodalVector(mesh_);
  {
    const WriteArray values(atNodes);
    for (std::size_t i = 0; i < contact_.interfaces.nodes.size(); ++i)
      for (int d = 0; d < dimension; ++d)
        values[dimension * contact_.interfaces.nodes[i].node + d] = onPads[i][d];
  }
  OwnedVec contactForces = elasticity::nodalVector(mesh_);
  check(MatMultTranspose(contact_.sliding.jump, atNodes, contactForces));
  contactForces = withTieForces(contact_, balanced, contact_.movedFromLayers(contactForces));
  // [part][contact, supports, load][component], and at the end the sum of all magnitudes, the scale
  // of the terms that cancel: resultants may be zero.
  std::vector<double> sums(mesh_.parts * 9 + 1, 0.0);
  const auto at = [&](int part, int kind, int d) -> double& {
    return sums[part * 9 + kind * 3 + d];
  };
  const OwnedVec load = this->load(solution.at), springs = elasticity::nodalVector(mesh_);
  if (bodies_.springs) check(MatMult(bodies_.springs, solution.displacement, springs));
  if (bodies_.linkStiffness)
    check(MatMultAdd(bodies_.linkStiffness, solution.displacement, springs, springs));
  const ReadArray forces(balanced), loads(load), grounded(springs), contacts(contactForces);
  for (PetscInt node = 0; node < mesh_.ownedNodes; ++node)
    for (int d = 0; d < dimension && !mesh_.isRotation(mesh_.firstNode + node); ++d) {
      const int part = mesh_.nodePart[node];
      const PetscInt row = dimension * node + d;
      const double support =
          (contact_.interfaces.constraints.supported[row] ? forces[row] - contacts[row] : 0) -
          grounded[row];
      at(part, 0, d) += contacts[row];
      at(part, 1, d) += support;
      at(part, 2, d) += loads[row];
      sums.back() += std::abs(contacts[row]) + std::abs(support) + std::abs(loads[row]);
    }
  mpi::reduce<double>(mesh_.comm, sums, MPI_SUM);
  double worst = 0;
  for (int part = 0; part < mesh_.parts; ++part) {
    double rest = 0;
    for (int d = 0; d < dimension; ++d)
      rest += std::pow(at(part, 0, d) + at(part, 1, d) + at(part, 2, d), 2);
    worst = std::max(worst, std::sqrt(rest));
  }
  return sums.back() > 0 ? worst / sums.back() : 0;
}

}  // namespace squeal::steady
