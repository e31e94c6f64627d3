#include "linalg/inner.hpp"

namespace squeal::linalg {
namespace {

PetscErrorCode applySolver(PC pc, Vec in, Vec out) {
  KSP solver = nullptr;
  PetscFunctionBegin;
  PetscCall(PCShellGetContext(pc, &solver));
  PetscCall(KSPSolve(solver, in, out));
  PetscFunctionReturn(0);
}

}  // namespace

void preconditionBy(KSP solver, KSP inner) {
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, inner));
  check(PCShellSetApply(pc, applySolver));
}

}  // namespace squeal::linalg
