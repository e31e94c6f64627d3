// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/iterative_refinement.hpp"
#include "base/petsc/object.hpp"

#include <algorithm>

namespace squeal::steady {
namespace {

PetscErrorCode applySolver(PC pc, Vec in, Vec out) {
  KSP solver = nullptr;
  PetscFunctionBegin;
  PetscCall(PCShellGetContext(pc, &solver));
  PetscCall(KSPSolve(solver, in, out));
  PetscFunctionReturn(0);
}

/// Collective. Sets `inner` as preconditioner of `solver`, which borrows it: `inner` must outlive
/// the solves of `solver`.
void preconditionBy(KSP solver, KSP inner) {
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, inner));
  check(PCShellSetApply(pc, applySolver));
}

/// A residual below this multiple of its estimated round-off counts as round-off.
constexpr double roundings = 10;
/// A residual below this fraction of the initial one counts as zero.
constexpr double small = 1e-9;
/// The largest number of steps. With convective terms, which the inner solver omits in part, some
/// ten are needed.
constexpr int mostSteps = 20;

PetscReal norm(Vec vector) {
  PetscReal value = 0;
  check(VecNorm(vector, NORM_2, &value));
  return value;
}

}  // namespace

bool Refinement::solved() const { return least <= std::max(roundings * rounding, small * first); }

Refinement refine(KSP inner, const std::function<Residual(Vec)>& residual, Vec y) {
  Residual current = residual(y);
  Refinement result;
  result.first = result.least = norm(current.vector);
  result.rounding = current.rounding;
  OwnedVec step;
  check(VecDuplicate(y, step.out()));
  while (result.steps < mostSteps && result.least > result.rounding) {
    check(KSPSolve(inner, current.vector, step));  // the residual below is the test
    ++result.steps;
    check(VecAXPY(y, -1, step));
    Residual next = residual(y);
    const PetscReal before = result.least, now = norm(next.vector);
    if (!(now < before)) {
      check(VecAXPY(y, 1, step));
      break;
    }
    result.least = now;
    result.rounding = next.rounding;
    current = std::move(next);
    if (now > 0.5 * before) break;
  }
  return result;
}

OwnedKSP innerSolver(Mat matrix, KSP factorised) {
  OwnedKSP solver;
  check(KSPCreate(commOf(matrix), solver.out()));
  check(KSPSetOperators(solver, matrix, matrix));
  check(KSPSetType(solver, KSPGMRES));
  // Eight digits per step: GMRES stagnates some digits above round-off, refinement does not.
  check(KSPSetTolerances(solver, 1e-8, PETSC_DEFAULT, PETSC_DEFAULT, 100));
  check(KSPGMRESSetRestart(solver, 100));
  // With right preconditioning the tolerance applies to forces. If a weakly supported body moves
  // far, a tolerance on displacements would hide all other errors.
  check(KSPSetPCSide(solver, PC_RIGHT));
  preconditionBy(solver, factorised);
  return solver;
}

}  // namespace squeal::steady
