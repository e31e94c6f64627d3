// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Handles termination from outside: signals, MPI_Abort after an error of a library, and exit() in
/// a library. Termination handlers remove everything that a run must not leave behind.
#include <mpi.h>

#include <functional>

namespace squeal {

/// Registers a handler to run if the process is terminated from outside during the object's
/// lifetime. On normal exit the owner does the work itself.
class AtTermination {
 public:
  /// Registers the handler. It may run in a separate thread, concurrently with the run, and must
  /// not call MPI.
  explicit AtTermination(std::function<void()> handler);
  ~AtTermination();
  AtTermination(const AtTermination&) = delete;
  AtTermination& operator=(const AtTermination&) = delete;

 private:
  std::function<void()> handler_;
};

/// Delays termination from outside during the object's lifetime. If termination has started
/// already, the constructor does not return. Use it for short work that must not be interrupted,
/// and for files that must not appear while termination handlers remove them.
class SignalsBlocked {
 public:
  SignalsBlocked();
  ~SignalsBlocked();
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
};

/// Not collective. Runs all termination handlers. Call it before MPI_Abort.
void runTerminationHandlers() noexcept;

/// Not collective. Runs all termination handlers and ends all ranks with exit code 1. Use it where
/// an exception would have to pass through the C code of a library; the caller reports the reason.
[[noreturn]] void abortRun() noexcept;

/// Thrown on all ranks together when a run stops on request. It is not an error, so it does not
/// derive from std::exception.
struct Interrupted {};

/// Not collective. Returns true once SIGTERM or SIGUSR1 has requested a stop on this rank.
bool stopRequested();
/// Collective. Throws Interrupted on all ranks once a stop has been requested on any of them.
void stopIfRequested(MPI_Comm comm);

/// Does the work. Returns false if the work throws Interrupted; its results so far remain.
bool completed(const std::function<void()>& work);

/// Returns true once a stop has been requested on any rank.
using StopRequested = std::function<bool()>;

/// Collective. Runs work(stopRequested) independently on each rank: the work makes no collective
/// calls, and may take longer on one rank than on another. The work must call stopRequested(),
/// which is cheap, at short intervals, and must return or throw Interrupted once stopRequested()
/// returns true. If a stop has been requested on any rank, workIndependently() throws Interrupted
/// on all ranks. Otherwise, if the work throws Error on any rank, it throws Error on all ranks.
void workIndependently(MPI_Comm comm,
                       const std::function<void(const StopRequested& stopRequested)>& work);

/// Handles the signals by which batch systems, mpirun and the terminal end the program. SIGUSR1 and
/// SIGTERM request a stop at the next possible point, see stopRequested(). For the others (SIGINT,
/// SIGHUP, …), a thread runs the termination handlers, reports the signal in one line on rank 0,
/// and ends the process by this signal. It does the same for a SIGTERM more than 5 s after the
/// first request, or if mpirun is expected to send SIGKILL too soon after SIGTERM. Signals that are
/// already ignored (nohup) remain ignored. A write to a closed pipe or beyond the file size limit
/// only makes that write fail. A crash (SIGSEGV, SIGABRT, …) is reported in one line, without the
/// termination handlers.
class SignalWatch {
 public:
  /// Records which signals are ignored, and whether mpirun started the run. Construct the object
  /// before MPI and PETSc start, because they set their own variables and handlers.
  SignalWatch();
  /// Installs the handlers. Call it after PETSc has started. Throws Error if a pipe cannot be
  /// created.
  void begin(int rank);

 private:
  unsigned long ignored_ = 0;  ///< a bit per signal
  bool hasTime_;               ///< SIGTERM leaves the run time to stop
};

}  // namespace squeal
