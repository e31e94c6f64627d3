// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Errors, and functions that share them between all ranks.
#include <mpi.h>

#include <new>
#include <source_location>
#include <stdexcept>
#include <string>

#include "base/system/mpi.hpp"

namespace squeal {

/// A wrong input, or a problem without a solution. The message names the option or group and the
/// violated rule. A collective function throws Error on all ranks of the communicator, so the
/// program ends without a deadlock. A function that is not collective throws it only on its rank,
/// and the caller shares it by onFirstRank() or failTogether().
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Not collective. Ends all ranks by MPI_Abort with one line on stderr if `holds` is false. Use it
/// for invariants of the code, such as matching sizes of matrices: a failure is a defect of the
/// program. Every build makes these checks, so use ensure() only where the check costs little.
inline void ensure(bool holds, const char* rule,
                   std::source_location where = std::source_location::current());
/// Not collective. Reports a violated invariant and ends all ranks.
[[noreturn]] void reportDefect(const char* rule, std::source_location where);

inline void ensure(bool holds, const char* rule, std::source_location where) {
  if (!holds) [[unlikely]]
    reportDefect(rule, where);
}

/// Collective. Throws Error on all ranks with the message of the lowest rank whose `localMessage`
/// is not empty. Returns if all are empty.
void failTogether(MPI_Comm comm, const std::string& localMessage);

/// Collective. Runs `action()` on rank 0 only. Throws Error on all ranks if the action throws an
/// exception; the message is `head` followed by that of the exception.
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
