// SPDX-License-Identifier: BSD-2-Clause
#include "base/petsc/check.hpp"

#include <petscblaslapack.h>

#include <cstdlib>
#include <vector>

#include "base/system/memory.hpp"
#include "base/system/termination.hpp"

namespace squeal {

namespace {

CapturedError* active = nullptr;

bool allocationFailed = false;

/// Replaces PETSc's handler, which prints a trace if an allocation fails. This one forwards the
/// code to check(), which reports it in one line. PetscMallocAlign of PETSc 3.18 raises a line
/// number instead of PETSC_ERR_MEM, and is recognised by its name.
PetscErrorCode handleError(MPI_Comm comm, int line, const char* function, const char* file,
                           PetscErrorCode code, PetscErrorType type, const char* message,
                           void* context) {
  if (type == PETSC_ERROR_INITIAL)
    allocationFailed =
        code == PETSC_ERR_MEM || (function && std::string(function) == "PetscMallocAlign");
  if (allocationFailed || CapturedError::record(code, message)) return code;
  return PetscTraceBackErrorHandler(comm, line, function, file, code, type, message, context);
}

}  // namespace

CapturedError::CapturedError() { active = this; }

CapturedError::~CapturedError() { active = nullptr; }

bool CapturedError::record(PetscErrorCode code, const char* message) {
  if (!active) return false;
  if (active->code_ == 0) {  // the calling functions repeat it
    active->code_ = code;
    active->message_ = message ? message : "";
  }
  return true;
}

void check(PetscErrorCode code, std::source_location where) {
  if (code == 0) return;
  if (lacksMemory(code)) outOfMemory();
  const std::string recorded = active ? active->message() : "";  // not printed yet
  active = nullptr;
  PetscError(PETSC_COMM_SELF, where.line(), where.function_name(), where.file_name(), code,
             recorded.empty() ? PETSC_ERROR_REPEAT : PETSC_ERROR_INITIAL, "%s",
             recorded.empty() ? " " : recorded.c_str());
  runTerminationHandlers();
  MPI_Abort(PETSC_COMM_WORLD, 70);
}

void reportLackOfMemoryInOneLine() { check(PetscPushErrorHandler(handleError, nullptr)); }

bool lacksMemory(PetscErrorCode code) {
  return code != 0 && (allocationFailed || code == PETSC_ERR_MEM);
}

void allocateBlasWorkspace() {
  constexpr std::size_t workspace = 160u << 20;  // OpenBLAS takes 128 MB
  if (void* room = std::malloc(workspace))
    std::free(room);
  else
    outOfMemory();
  PetscBLASInt n = 128;  // smaller products may not need the workspace
  const PetscScalar one = 1;
  const std::vector<PetscScalar> a(n * n, 1.0);
  std::vector<PetscScalar> product(a.size(), 0.0);
  BLASgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &one, product.data(), &n);
}

}  // namespace squeal
