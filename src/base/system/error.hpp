#pragma once
/// Errors, and how all ranks come to share them.
#include <mpi.h>

#include <new>
#include <source_location>
#include <stdexcept>
#include <string>

#include "base/system/mpi.hpp"

namespace squeal {

/// An Error reports a mistake in the input or a problem without an answer. The message names the
/// option or group and the rule it breaks. A collective function throws it on all ranks of the
/// communicator together, so that the program ends without a hang. Another function throws it on
/// its rank alone, and the caller shares it by onFirstRank() or failTogether().
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

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

/// Collective. Throws Error on all ranks with the message of the lowest rank whose `localMessage`
/// is not empty. Returns if all are empty.
void failTogether(MPI_Comm comm, const std::string& localMessage);

/// Collective. Runs `action()` on rank 0 only. Throws Error on all ranks if the action throws an
/// exception; the message is `head` and that of the exception.
template <class Action>
void onFirstRank(MPI_Comm comm, const std::string& head, const Action& action) {
  std::string failure;
  if (mpi::rank(comm) == 0) try {
      action();
    } catch (const std::bad_alloc&) {
      failure = head + "not enough memory";
    } catch (const std::exception& error) {
      failure = head + error.what();
    }
  failTogether(comm, failure);
}

}  // namespace squeal
