#include "steady/steady.hpp"

#include <petscsnes.h>

#include <algorithm>
#include <cmath>

#include "petsc/options.hpp"

namespace squeal::steady {
namespace {

const SolverPrefix solverPrefix("steady", "steady_", "PETSc SNES VI, KSP and PC of steady sliding: snes_*, ksp_*, pc_*, …");

using OwnedSNES = Owned<SNES, SNESDestroy>;

/// The problem in units of its own size, x = xUnit x̂ and F = forceUnit F̂, so that the tolerances of SNES, absolute ones among
/// them (-steady_snes_vi_zero_tolerance is 1e-8), mean the same in metres and in millimetres.
struct Scaled {
  Mat jacobian;  // n×n, F̂ = jacobian x̂ + constant
  Vec constant;
};

PetscErrorCode evaluate(SNES, Vec x, Vec f, void* context) {
  const auto* scaled = static_cast<const Scaled*>(context);
  PetscFunctionBegin;
  PetscCall(MatMultAdd(scaled->jacobian, x, scaled->constant, f));
  PetscFunctionReturn(0);
}

PetscErrorCode keepJacobian(SNES, Vec, Mat, Mat, void*) { return 0; }  // approximation A: F is affine

PetscErrorCode applySolver(PC pc, Vec in, Vec out) {
  KSP solver = nullptr;
  PetscFunctionBegin;
  PetscCall(PCShellGetContext(pc, &solver));
  PetscCall(KSPSolve(solver, in, out));
  PetscFunctionReturn(0);
}

OwnedVec rightVector(Mat matrix) {
  OwnedVec vector;
  check(MatCreateVecs(matrix, vector.out(), nullptr));
  return vector;
}

/// L(f)ᵀ r = Tᵀ r + f Eᵀ r.
OwnedVec tested(const contact::Transformation& transformation, double friction, Vec r) {
  OwnedVec result = rightVector(transformation.trial), part = rightVector(transformation.trial);
  check(MatMultTranspose(transformation.friction, r, part));
  check(MatMultTranspose(transformation.trial, r, result));
  check(VecAXPY(result, friction, part));
  return result;
}

}  // namespace

Problem::Problem(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, const contact::Contact& contact)
    : mesh_(mesh), bodies_(bodies), contact_(contact), residual0_(elasticity::nodalVector(mesh)) {
  const std::vector<unsigned char> all(contact.nodes.size(), 1);
  matrices_ = contact::couple(bodies, contact, all, all, false);
  check(MatMult(bodies.stiffness, contact.offset, residual0_));
  check(VecAXPY(residual0_, -1, bodies.load));
}

Solution Problem::solve(double friction, const contact::AssociatedSystem& system) const {
  Solution solution;
  solution.friction = friction;
  OwnedVec x = guess(friction, system);
  if (contact_.weightsPositive) {
    complementarity(x, solution);
  } else {
    solution.converged = true;
    solution.reason = "closed contact held (faces with non-positive nodal weights)";
  }
  recover(x, solution);
  if (!contact_.weightsPositive && solution.smallestPressure < 0) {
    solution.converged = false;
    solution.reason =
        "contact opens, which cannot be decided node by node on tri6 or quad8 faces; mesh the contact faces with linear or 9-node "
        "elements";
  }
  return solution;
}

/// Solves the linear problem with the gaps of the active set held at zero: GMRES on L(f)ᵀ K T, preconditioned by the factorised K0.
OwnedVec Problem::guess(double friction, const contact::AssociatedSystem& system) const {
  const auto& closed = system.matrices();
  const OwnedMat jacobian = contact::CoupledMatrices::affine(closed.k0, closed.k1, friction);
  const OwnedVec rhs = tested(closed.transformation, friction, residual0_), y = rightVector(closed.k0);
  check(VecScale(rhs, -1));
  OwnedKSP solver;
  check(KSPCreate(mesh_.comm, solver.out()));
  check(KSPSetOperators(solver, jacobian, closed.k0));
  check(KSPSetType(solver, KSPGMRES));
  check(KSPSetTolerances(solver, 1e-13, PETSC_DEFAULT, PETSC_DEFAULT, 200));
  check(KSPGMRESSetRestart(solver, 200));
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, system.solver()));
  check(PCShellSetApply(pc, applySolver));
  check(KSPSolve(solver, rhs, y));
  KSPConvergedReason reason;
  check(KSPGetConvergedReason(solver, &reason));
  if (reason < 0) check(KSPSolve(system.solver(), rhs, y));  // near a friction without solution: the frictionless guess
  const OwnedVec z = elasticity::nodalVector(mesh_);
  OwnedVec x = rightVector(matrices_.k0);
  check(MatMult(closed.transformation.selection, y, z));
  check(MatMultTranspose(matrices_.transformation.selection, z, x));
  return x;
}

void Problem::complementarity(OwnedVec& x, Solution& solution) const {
  const double friction = solution.friction;
  PetscReal xUnit = 0, forceUnit = 0;
  check(VecNorm(x, NORM_INFINITY, &xUnit));
  const OwnedVec constant = tested(matrices_.transformation, friction, residual0_);
  check(VecNorm(constant, NORM_2, &forceUnit));
  if (xUnit == 0) xUnit = 1;
  if (forceUnit == 0) forceUnit = 1;
  OwnedMat jacobian = contact::CoupledMatrices::affine(matrices_.k0, matrices_.k1, friction), symmetric;
  check(MatDuplicate(matrices_.k0, MAT_COPY_VALUES, symmetric.out()));
  for (Mat matrix : {jacobian.get(), symmetric.get()}) check(MatScale(matrix, xUnit / forceUnit));
  check(VecScale(constant, 1 / forceUnit));
  check(VecScale(x, 1 / xUnit));
  Scaled scaled{jacobian, constant};

  const OwnedVec low = rightVector(jacobian), high = rightVector(jacobian);
  check(VecSet(low, PETSC_NINFINITY));
  check(VecSet(high, PETSC_INFINITY));
  for (PetscInt column : matrices_.transformation.gapColumn) check(VecSetValue(low, column, 0, INSERT_VALUES));
  check(VecAssemblyBegin(low));
  check(VecAssemblyEnd(low));

  OwnedSNES snes;
  check(SNESCreate(mesh_.comm, snes.out()));
  check(SNESSetOptionsPrefix(snes, solverPrefix.prefix.c_str()));
  check(SNESSetType(snes, SNESVINEWTONRSLS));
  const OwnedVec residual = rightVector(jacobian);
  check(SNESSetFunction(snes, residual, evaluate, &scaled));
  check(SNESSetJacobian(snes, jacobian, symmetric, keepJacobian, nullptr));
  check(SNESVISetVariableBounds(snes, low, high));
  check(SNESSetTolerances(snes, 1e-11, 1e-14, 0, 30, 1000));
  KSP ksp = nullptr;
  PC pc = nullptr;
  check(SNESGetKSP(snes, &ksp));
  check(KSPSetType(ksp, KSPGMRES));
  check(KSPSetTolerances(ksp, 1e-12, PETSC_DEFAULT, PETSC_DEFAULT, 200));
  check(KSPGMRESSetRestart(ksp, 200));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCCHOLESKY));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(SNESSetFromOptions(snes));
  solverPrefix.rejectUnused({"mat_mumps_"});
  check(SNESSolve(snes, nullptr, x));
  SNESConvergedReason reason;
  PetscInt iterations = 0;
  check(SNESGetConvergedReason(snes, &reason));
  check(SNESGetIterationNumber(snes, &iterations));
  solution.reason = SNESConvergedReasons[reason];
  solution.converged = reason > 0;
  solution.iterations = static_cast<int>(iterations);
  check(VecScale(x, xUnit));
}

void Problem::recover(Vec x, Solution& solution) const {
  solution.displacement = elasticity::nodalVector(mesh_);
  const OwnedVec force = elasticity::nodalVector(mesh_);
  check(MatMultAdd(matrices_.transformation.trial, x, contact_.offset, solution.displacement));
  check(MatMult(bodies_.stiffness, solution.displacement, force));
  check(VecAXPY(force, -1, bodies_.load));  // K u − b: supports and contact forces
  const OwnedVec folded = elasticity::nodalVector(mesh_);
  check(MatMultTranspose(contact_.periodic, force, folded));  // a contact node on a periodic boundary is pressed on both sides

  PetscInt first = 0;
  check(VecGetOwnershipRange(x, &first, nullptr));
  const PetscScalar *values = nullptr, *forces = nullptr;
  check(VecGetArrayRead(x, &values));
  check(VecGetArrayRead(folded, &forces));
  double largest = 0;
  for (std::size_t i = 0; i < contact_.nodes.size(); ++i) {
    const auto& node = contact_.nodes[i];
    ContactState state;
    state.gap = values[matrices_.transformation.gapColumn[i] - first];
    for (int d = 0; d < mesh_.dimension; ++d)
      state.normalForce += forces[mesh_.dimension * node.node + d] * node.normal[static_cast<std::size_t>(d)];
    for (std::size_t d = 0; d < 3; ++d) state.frictionForce[d] = -solution.friction * state.normalForce * node.slip[d];
    state.pressure = state.normalForce / node.area;
    largest = std::max(largest, std::abs(state.normalForce));
    solution.contact.push_back(state);
  }
  check(VecRestoreArrayRead(x, &values));
  check(VecRestoreArrayRead(folded, &forces));
  check(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, mesh_.comm));
  if (!contact_.weightsPositive) {
    const auto pressure = consistentPressure(mesh_, contact_, solution.contact);
    for (std::size_t i = 0; i < pressure.size(); ++i) solution.contact[i].pressure = pressure[i];
  }
  double smallest = INFINITY;
  for (const auto& state : solution.contact) {
    // SNES leaves an inactive gap with a force of the order of its tolerance.
    const bool closed = !contact_.weightsPositive || state.normalForce > 1e-8 * largest;
    solution.closed.push_back(closed);
    solution.openNodes += !closed;
    smallest = std::min(smallest, state.pressure);
  }
  check(MPI_Allreduce(MPI_IN_PLACE, &solution.openNodes, 1, MPIU_INT, MPI_SUM, mesh_.comm));
  check(MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPI_DOUBLE, MPI_MIN, mesh_.comm));
  solution.smallestPressure = contact_.totalNodes ? smallest : 0;

  for (std::size_t i = 0; i < contact_.interfaces.size(); ++i) {
    Resultant resultant{contact_.interfaces[i], {}, {}};
    for (std::size_t k = 0; k < contact_.nodes.size(); ++k)
      if (contact_.nodes[k].interface == static_cast<int>(i))
        for (std::size_t d = 0; d < 3; ++d) {
          resultant.normalForce[d] += solution.contact[k].normalForce * contact_.nodes[k].normal[d];
          resultant.frictionForce[d] += solution.contact[k].frictionForce[d];
        }
    check(MPI_Allreduce(MPI_IN_PLACE, resultant.normalForce.data(), 3, MPI_DOUBLE, MPI_SUM, mesh_.comm));
    check(MPI_Allreduce(MPI_IN_PLACE, resultant.frictionForce.data(), 3, MPI_DOUBLE, MPI_SUM, mesh_.comm));
    solution.resultants.push_back(resultant);
  }
  solution.imbalance = imbalance(solution, folded);
}

/// Newton's third law as a check of signs and solution: contact by the friction law, supports where components are held, and loads.
double Problem::imbalance(const Solution& solution, Vec nodalForces) const {
  const int dimension = mesh_.dimension;
  const OwnedVec contactForces = elasticity::nodalVector(mesh_);
  for (std::size_t i = 0; i < contact_.nodes.size(); ++i)
    for (int d = 0; d < dimension; ++d) {
      const auto& node = contact_.nodes[i];
      const auto c = static_cast<std::size_t>(d);
      const double force = solution.contact[i].normalForce * node.normal[c] + solution.contact[i].frictionForce[c];
      check(VecSetValue(contactForces, dimension * node.globalNode + d, force, ADD_VALUES));
      if (node.master >= 0) check(VecSetValue(contactForces, dimension * node.master + d, -force, ADD_VALUES));
    }
  check(VecAssemblyBegin(contactForces));
  check(VecAssemblyEnd(contactForces));
  // [part][contact, supports, load][component]
  // and at the end the sum of all magnitudes, the scale of what cancels: resultants may vanish on their own.
  std::vector<double> sums(static_cast<std::size_t>(mesh_.parts) * 9 + 1, 0.0);
  const auto at = [&](int part, int kind, int d) -> double& { return sums[static_cast<std::size_t>(part * 9 + kind * 3 + d)]; };
  const PetscScalar *forces = nullptr, *loads = nullptr, *contacts = nullptr;
  check(VecGetArrayRead(nodalForces, &forces));
  check(VecGetArrayRead(bodies_.load, &loads));
  check(VecGetArrayRead(contactForces, &contacts));
  for (PetscInt node = 0; node < mesh_.ownedNodes; ++node)
    for (int d = 0; d < dimension; ++d) {
      const int part = mesh_.nodePart[static_cast<std::size_t>(node)];
      const PetscInt row = dimension * node + d;
      const double support = contact_.constraints.held[static_cast<std::size_t>(row)] ? forces[row] - contacts[row] : 0;
      at(part, 0, d) += contacts[row];
      at(part, 1, d) += support;
      at(part, 2, d) += loads[row];
      sums.back() += std::abs(contacts[row]) + std::abs(support) + std::abs(loads[row]);
    }
  check(VecRestoreArrayRead(nodalForces, &forces));
  check(VecRestoreArrayRead(bodies_.load, &loads));
  check(VecRestoreArrayRead(contactForces, &contacts));
  check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, mesh_.comm));
  double worst = 0;
  for (int part = 0; part < mesh_.parts; ++part) {
    double rest = 0;
    for (int d = 0; d < dimension; ++d) rest += std::pow(at(part, 0, d) + at(part, 1, d) + at(part, 2, d), 2);
    worst = std::max(worst, std::sqrt(rest));
  }
  return sums.back() > 0 ? worst / sums.back() : 0;
}

}  // namespace squeal::steady
