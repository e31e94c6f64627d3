#pragma once
/// The calls of PETSc are checked, and its errors become messages of one line.
#include <petscsys.h>

#include <source_location>
#include <string>

#include "base/system/error.hpp"

namespace squeal {

/// Not collective. Checks the return code of a PETSc, SLEPc or MPI call. A failure there is a
/// defect or a lack of memory, perhaps on this rank alone: one line on memory or the PETSc
/// traceback is printed, and MPI_Abort ends all ranks.
void check(PetscErrorCode code, std::source_location where = std::source_location::current());

/// During the life of a KeptError, the first error of PETSc is kept as text, and PETSc prints no
/// traceback of it. Only one object may live at a time.
class KeptError {
 public:
  KeptError();
  ~KeptError();
  KeptError(const KeptError&) = delete;
  KeptError& operator=(const KeptError&) = delete;
  PetscErrorCode code() const { return code_; }
  /// Returns PETSc's message, such as "Unknown EPS type given: foo".
  const std::string& message() const { return message_; }
  /// Keeps the first error in the object that lives. The error handler calls it. Returns false if
  /// no object lives.
  static bool keep(PetscErrorCode code, const char* message);

 private:
  PetscErrorCode code_ = 0;
  std::string message_;
};

/// Makes PETSc print no traceback of failed allocations from here on.
void reportLackOfMemoryInOneLine();

/// Returns true if the error code of a PETSc call means that an allocation has failed.
bool lacksMemory(PetscErrorCode code);

/// Makes OpenBLAS allocate its workspace, once for all calls of this thread, or ends the run if
/// there is no memory. OpenBLAS itself would retry for ever.
void claimBlasWorkspace();

}  // namespace squeal
