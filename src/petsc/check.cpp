#include "petsc/check.hpp"

#include "petsc/memory.hpp"
#include "petsc/termination.hpp"

namespace squeal {

void check(PetscErrorCode code, std::source_location where) {
  if (code == 0) return;
  if (lacksMemory(code)) outOfMemory();
  PetscError(PETSC_COMM_SELF, static_cast<int>(where.line()), where.function_name(), where.file_name(), code, PETSC_ERROR_REPEAT,
             " ");
  performLastActs();
  MPI_Abort(PETSC_COMM_WORLD, 70);
}

void failTogether(MPI_Comm comm, const std::string& localMessage) {
  int rank = 0, size = 1;
  check(MPI_Comm_rank(comm, &rank));
  check(MPI_Comm_size(comm, &size));
  int mine = localMessage.empty() ? size : rank, first = size;
  check(MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm));
  if (first == size) return;
  int length = static_cast<int>(localMessage.size());
  check(MPI_Bcast(&length, 1, MPI_INT, first, comm));
  std::string message = localMessage;
  message.resize(static_cast<std::size_t>(length));
  check(MPI_Bcast(message.data(), length, MPI_CHAR, first, comm));
  throw Error(message);
}

}  // namespace squeal
