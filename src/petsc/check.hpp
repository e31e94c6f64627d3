#pragma once
/// This file holds errors, and shares them with all ranks.
#include <petscsys.h>

#include <new>
#include <source_location>
#include <stdexcept>
#include <string>

namespace squeal {

/// An Error reports a mistake in the input or a problem without an answer. The message names the
/// option or group and the rule it breaks. A collective function throws it on all ranks of the
/// communicator together, so that the program ends without a hang. Another function throws it on
/// its rank alone, and the caller shares it by onFirstRank() or failTogether().
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Not collective. Checks the return code of a PETSc, SLEPc or MPI call. A failure there is a
/// defect or a lack of memory, perhaps on this rank alone: one line on memory or the PETSc
/// traceback is printed, and MPI_Abort ends all ranks.
void check(PetscErrorCode code, std::source_location where = std::source_location::current());

/// Not collective. Ends all ranks by MPI_Abort with one line on stderr if `holds` is false. Checks
/// what the code itself guarantees, such as the sizes of matrices: a failure is a defect of the
/// program. It is in force in every build, so use it only where it costs little.
inline void ensure(bool holds, const char* rule,
                   std::source_location where = std::source_location::current());
/// Not collective. Reports a broken rule of the program and ends all ranks.
[[noreturn]] void reportDefect(const char* rule, std::source_location where);

inline void ensure(bool holds, const char* rule, std::source_location where) {
  if (!holds) [[unlikely]]
    reportDefect(rule, where);
}

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

/// Collective. Throws Error on all ranks with the message of the lowest rank whose `localMessage`
/// is not empty. Returns if all are empty.
void failTogether(MPI_Comm comm, const std::string& localMessage);

/// Collective. Runs `action()` on rank 0 only. Throws Error on all ranks if the action throws an
/// exception; the message is `head` and that of the exception.
template <class Action>
void onFirstRank(MPI_Comm comm, const std::string& head, const Action& action) {
  int rank = 0;
  check(MPI_Comm_rank(comm, &rank));
  std::string failure;
  if (rank == 0) try {
      action();
    } catch (const std::bad_alloc&) {
      failure = head + "not enough memory";
    } catch (const std::exception& error) {
      failure = head + error.what();
    }
  failTogether(comm, failure);
}

}  // namespace squeal
