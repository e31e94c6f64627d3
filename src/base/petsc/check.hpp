// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks PETSc calls, and turns PETSc's errors into one-line messages.
#include <petscsys.h>

#include <source_location>
#include <string>

#include "base/system/error.hpp"

namespace squeal {

/// Not collective. Checks the return code of a PETSc, SLEPc or MPI call. A failure is a defect of
/// the program or a lack of memory, perhaps only on this rank. The function then prints one line
/// (lack of memory) or the PETSc traceback, and ends all ranks by MPI_Abort.
void check(PetscErrorCode code, std::source_location where = std::source_location::current());

/// Stores the first PETSc error during the object's lifetime, and suppresses its traceback. Only
/// one object may exist at a time. Requires the handler of reportLackOfMemoryInOneLine().
class CapturedError {
 public:
  CapturedError();
  ~CapturedError();
  CapturedError(const CapturedError&) = delete;
  CapturedError& operator=(const CapturedError&) = delete;
  PetscErrorCode code() const { return code_; }
  /// Returns PETSc's message, such as "Unknown EPS type given: foo".
  const std::string& message() const { return message_; }
  /// Stores an error in the existing object unless it already has one; called by the error handler.
  /// Returns false if no object exists.
  static bool record(PetscErrorCode code, const char* message);

 private:
  PetscErrorCode code_ = 0;
  std::string message_;
};

/// Installs an error handler that suppresses PETSc's traceback of failed allocations and fills
/// CapturedError.
void reportLackOfMemoryInOneLine();

/// Returns true if the error code of a PETSc call means that an allocation has failed.
bool lacksMemory(PetscErrorCode code);

/// Makes OpenBLAS allocate its workspace, once for all calls of this thread. Ends the run if there
/// is not enough memory, since OpenBLAS itself would retry forever.
void allocateBlasWorkspace();

}  // namespace squeal
