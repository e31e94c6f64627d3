#include "petsc/check.hpp"

#include <cstdio>
#include <cstdlib>

#include "petsc/memory.hpp"
#include "petsc/termination.hpp"

namespace squeal {

namespace {

KeptError* keeper = nullptr;

}  // namespace

KeptError::KeptError() { keeper = this; }

KeptError::~KeptError() { keeper = nullptr; }

bool KeptError::keep(PetscErrorCode code, const char* message) {
  if (!keeper) return false;
  if (keeper->code_ == 0) {  // functions on the way up repeat it
    keeper->code_ = code;
    keeper->message_ = message ? message : "";
  }
  return true;
}

void check(PetscErrorCode code, std::source_location where) {
  if (code == 0) return;
  if (lacksMemory(code)) outOfMemory();
  const std::string kept = keeper ? keeper->message() : "";  // what has not been printed yet
  keeper = nullptr;
  PetscError(PETSC_COMM_SELF, where.line(), where.function_name(), where.file_name(), code,
             kept.empty() ? PETSC_ERROR_REPEAT : PETSC_ERROR_INITIAL, "%s",
             kept.empty() ? " " : kept.c_str());
  performLastActs();
  MPI_Abort(PETSC_COMM_WORLD, 70);
}

void reportDefect(const char* rule, std::source_location where) {
  std::fprintf(stderr, "squeal: error: a defect of the program: %s (%s, %s:%u); please report it\n",
               rule, where.function_name(), where.file_name(), unsigned(where.line()));
  performLastActs();
  MPI_Abort(MPI_COMM_WORLD, 70);
  std::abort();
}

void failTogether(MPI_Comm comm, const std::string& localMessage) {
  int rank = 0, size = 1;
  check(MPI_Comm_rank(comm, &rank));
  check(MPI_Comm_size(comm, &size));
  int mine = localMessage.empty() ? size : rank, first = size;
  check(MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm));
  if (first == size) return;
  int length = localMessage.size();
  check(MPI_Bcast(&length, 1, MPI_INT, first, comm));
  std::string message = localMessage;
  message.resize(length);
  check(MPI_Bcast(message.data(), length, MPI_CHAR, first, comm));
  throw Error(message);
}

}  // namespace squeal
