#include "petsc/memory.hpp"

#include <malloc.h>

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "petsc/check.hpp"
#include "petsc/termination.hpp"

namespace squeal {
namespace {

/// Returns the first number in a file of /proc or /sys; none if there is no such file, or if it
/// says "max".
std::optional<double> numberIn(const std::string& path) {
  double value = 0;
  if (std::ifstream file(path); file >> value) return value;
  return {};
}

/// Returns the number behind `name` in a table of /proc or /sys; none if the table has no such
/// line.
std::optional<double> entryOf(const std::string& path, const std::string& name) {
  std::ifstream file(path);
  for (std::string line, word; std::getline(file, line);)
    if (double value = 0; std::istringstream(line) >> word >> value && word == name) return value;
  return {};
}

bool lacks = false;

/// Handles an error of PETSc, whose own handler prints a trace where an allocation fails. The code
/// alone goes up to check(), which says it in one line. The code that PetscMallocAlign of PETSc
/// 3.18 raises is the number of a line instead of PETSC_ERR_MEM: the name of the function tells.
PetscErrorCode handleError(MPI_Comm comm, int line, const char* function, const char* file,
                           PetscErrorCode code, PetscErrorType type, const char* message,
                           void* context) {
  if (type == PETSC_ERROR_INITIAL)
    lacks = code == PETSC_ERR_MEM || (function && std::string(function) == "PetscMallocAlign");
  if (lacks || KeptError::keep(code, message)) return code;
  return PetscTraceBackErrorHandler(comm, line, function, file, code, type, message, context);
}

}  // namespace

double addressSpace() {
  // The first number in the file is that of all pages.
  return numberIn("/proc/self/statm").value_or(0) * sysconf(_SC_PAGESIZE);
}

double availableMemory() {
  double bytes = 1024 * entryOf("/proc/meminfo", "MemAvailable:").value_or(1e15);
  // A batch job may have a limit of its own, in version 2 of the control groups or in version 1.
  // The kernel gives back the memory in which it caches files.
  struct Group {
    const char *most, *used, *details, *cached;
  };
  for (const auto& [most, used, details, cached] :
       {Group{"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current",
              "/sys/fs/cgroup/memory.stat", "file"},
        Group{"/sys/fs/cgroup/memory/memory.limit_in_bytes",
              "/sys/fs/cgroup/memory/memory.usage_in_bytes", "/sys/fs/cgroup/memory/memory.stat",
              "cache"}})
    if (const auto all = numberIn(most), now = numberIn(used); all && now)
      bytes = std::min(bytes, std::max(0.0, *all - *now + entryOf(details, cached).value_or(0)));
  return bytes;
}

double memoryFreeOnNode(MPI_Comm comm, double& needed) {
  MPI_Comm node = MPI_COMM_NULL;
  check(MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node));
  check(MPI_Allreduce(MPI_IN_PLACE, &needed, 1, MPI_DOUBLE, MPI_SUM, node));
  check(MPI_Comm_free(&node));
  return availableMemory();
}

void tellLackOfMemoryInOneLine() { check(PetscPushErrorHandler(handleError, nullptr)); }

bool lacksMemory(PetscErrorCode code) { return code != 0 && (lacks || code == PETSC_ERR_MEM); }

void keepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
}

void claimBlasWorkspace() {
  constexpr std::size_t workspace = 160u << 20;  // OpenBLAS takes 128 MB
  if (void* room = std::malloc(workspace))
    std::free(room);
  else
    outOfMemory();
  PetscBLASInt n = 128;  // smaller products may do without
  const PetscScalar one = 1;
  const std::vector<PetscScalar> a(n * n, 1.0);
  std::vector<PetscScalar> product(a.size(), 0.0);
  BLASgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &one, product.data(), &n);
}

void outOfMemory() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::fprintf(stderr, "squeal: error: rank %d got no more memory: %s\n", rank, lessMemory);
  abortRun();
}

}  // namespace squeal
