// SPDX-License-Identifier: BSD-2-Clause
#include "steady/condensed/gaps.hpp"

#include <petscsnes.h>

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"
#include "steady/steady/complementarity.hpp"

namespace squeal::condensed {

using impedance::ContactCase;

namespace {

/// The context of SNES, of the Jacobian and of its parts.
struct GapProblem {
  impedance::ContactSolver& solver;
  ContactCase contactCase;    // `free` marks the gaps that SNES lets open
  double gapUnit, forceUnit;  // m, N
  MPI_Comm comm;
  PetscInt first;  // number of the first contact node of this rank
  std::size_t nodes;
  std::vector<unsigned char> before = {};  // `free` of the Newton step before the last
};

/// Collective. Names the nodes whose state alternates in the last two Newton steps; empty if there
/// are none.
std::string alternating(const GapProblem& problem, const contact::Contact& contact) {
  int count = 0;
  std::size_t one = 0;
  for (std::size_t i = 0; i < problem.nodes && !problem.before.empty(); ++i)
    if (problem.before[i] != problem.contactCase.conditions.free[i] && count++ == 0) one = i;
  const auto most = mpi::maxLocated(problem.comm, count);
  count = mpi::sum(problem.comm, count);
  if (count == 0) return "";
  mesh::Point position{};
  if (mpi::rank(problem.comm) == most.rank) position = contact.interfaces.nodes[one].position;
  mpi::broadcast(problem.comm, position, most.rank);
  return formatted("%d %s in turn, such as that at %s", count,
                   count == 1 ? "contact node opens and closes" : "contact nodes open and close",
                   interfaces::text(position).c_str());
}

/// Sets F(g) in units, with the friction in balance.
void forces(GapProblem& problem, const ContactCase& contactCase, Vec gaps, Vec f) {
  std::vector<double> scaled;
  for (const ReadArray values(gaps); double value : values)
    scaled.push_back(problem.gapUnit * value);
  const auto found = problem.solver.withGaps(scaled, contactCase);
  const WriteArray values(f);
  for (PetscInt i = 0; i < values.size(); ++i)
    values[i] = found.effects[values.size() + i] / problem.forceUnit;
}

/// The case without given forces.
ContactCase unloaded(const GapProblem& problem) {
  ContactCase result = problem.contactCase;
  std::ranges::fill(result.given, 0);
  return result;
}

PetscErrorCode evaluate(SNES, Vec gaps, Vec f, void* context) {
  auto& problem = *static_cast<GapProblem*>(context);
  PetscFunctionBegin;
  forces(problem, problem.contactCase, gaps, f);
  PetscFunctionReturn(0);
}

/// The Jacobian does not change.
PetscErrorCode differentiate(SNES, Vec, Mat, Mat, void*) { return 0; }

PetscErrorCode multiply(Mat jacobian, Vec gaps, Vec f) {
  GapProblem* problem = nullptr;
  PetscFunctionBegin;
  PetscCall(MatShellGetContext(jacobian, &problem));
  forces(*problem, unloaded(*problem), gaps, f);
  PetscFunctionReturn(0);
}

/// Returns the part of the Jacobian for the gaps that SNES lets open.
PetscErrorCode openPart(Mat jacobian, IS rows, IS, MatReuse, Mat* part) {
  GapProblem* problem = nullptr;
  PetscInt count = 0;
  const PetscInt* indices = nullptr;
  PetscFunctionBegin;
  PetscCall(MatShellGetContext(jacobian, &problem));
  PetscCall(ISGetLocalSize(rows, &count));
  PetscCall(ISGetIndices(rows, &indices));
  auto& free = problem->contactCase.conditions.free;
  problem->before = free;
  std::fill_n(free.begin(), problem->nodes, 0);
  for (PetscInt i = 0; i < count; ++i) free[indices[i] - problem->first] = 1;
  PetscCall(ISRestoreIndices(rows, &indices));
  PetscCall(
      MatCreateShell(problem->comm, count, count, PETSC_DETERMINE, PETSC_DETERMINE, problem, part));
  PetscFunctionReturn(0);
}

PetscErrorCode solvePart(PC pc, Vec right, Vec gaps) {
  GapProblem* problem = nullptr;
  PetscFunctionBegin;
  PetscCall(PCShellGetContext(pc, &problem));
  const auto& open = problem->contactCase.conditions.free;
  ContactCase contactCase = unloaded(*problem);
  {
    const ReadArray values(right);
    for (std::size_t i = 0, k = 0; i < problem->nodes; ++i)
      if (open[i]) contactCase.given[problem->nodes + i] = -problem->forceUnit * values[k++];
  }
  const auto found = problem->solver.solve(contactCase);
  const WriteArray values(gaps);
  for (std::size_t i = 0, k = 0; i < problem->nodes; ++i)
    if (open[i]) values[k++] = found.causes[problem->nodes + i] / problem->gapUnit;
  PetscFunctionReturn(0);
}

/// Collective. Returns the Jacobian of F(g) in units, whose context is the problem.
OwnedMat jacobianOf(GapProblem& problem) {
  const PetscInt n = problem.nodes;
  OwnedMat jacobian;
  check(MatCreateShell(problem.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, &problem,
                       jacobian.out()));
  check(MatShellSetOperation(jacobian, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  check(MatShellSetOperation(jacobian, MATOP_CREATE_SUBMATRIX,
                             reinterpret_cast<void (*)()>(openPart)));
  return jacobian;
}

/// Sets an exact solver for the parts of the Jacobian.
void setPartSolver(SNES snes, GapProblem& problem) {
  KSP ksp = nullptr;
  PC pc = nullptr;
  check(SNESGetKSP(snes, &ksp));
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, &problem));
  check(PCShellSetApply(pc, solvePart));
}

}  // namespace

bool solveGaps(const GapTask& task, std::vector<double>& gaps, steady::Solution& solution) {
  const MPI_Comm comm = task.contact.mesh->comm;
  const PetscInt n = gaps.size();
  GapProblem problem{.solver = task.solver,
                     .contactCase = task.contactCase,
                     .gapUnit = task.gapUnit,
                     .forceUnit = task.forceUnit,
                     .comm = comm,
                     .first = mpi::sumBefore(comm, n),
                     .nodes = gaps.size()};
  std::fill_n(problem.contactCase.conditions.free.begin(), n,
              1);  // while SNES uses the whole Jacobian
  const OwnedMat jacobian = jacobianOf(problem);
  const OwnedVec x = rightVector(jacobian), low = rightVector(jacobian),
                 high = rightVector(jacobian), f = rightVector(jacobian);
  {
    const WriteArray start(x);
    for (PetscInt i = 0; i < n; ++i) start[i] = gaps[i] / task.gapUnit;
  }
  {
    const WriteArray most(high);
    for (PetscInt i = 0; i < n; ++i)
      most[i] = task.contact.interfaces.nodes[i].separates ? PETSC_INFINITY : 0;
  }
  const steady::OwnedSNES snes = steady::newSnes(comm, task.accuracy);
  check(SNESSetFunction(snes, f, evaluate, &problem));
  check(SNESSetJacobian(snes, jacobian, jacobian, differentiate, nullptr));
  check(SNESVISetVariableBounds(snes, low, high));
  setPartSolver(snes, problem);
  const bool isFound = steady::solveSnes(snes, x, solution);
  if (!isFound)
    if (const std::string who = alternating(problem, task.contact); !who.empty())
      solution.reason += ": " + who;
  const ReadArray values(x);
  for (PetscInt i = 0; i < n; ++i) gaps[i] = task.gapUnit * values[i];
  return isFound;
}

}  // namespace squeal::condensed
