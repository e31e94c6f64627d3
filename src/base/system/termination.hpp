#pragma once
/// This file handles endings from outside: signals, MPI_Abort after an error of a library, and
/// exit() in a library. The last acts put away all that a run must not leave behind.
#include <mpi.h>

#include <functional>

namespace squeal {

/// A AtTermination registers work that an ending from outside still has to do while the object
/// lives. On a normal way out its owner does that work himself.
class AtTermination {
 public:
  /// Registers `act`. It may run in a thread of its own, beside whatever the run is doing, and may
  /// not call MPI.
  explicit AtTermination(std::function<void()> act);
  ~AtTermination();
  AtTermination(const AtTermination&) = delete;
  AtTermination& operator=(const AtTermination&) = delete;

 private:
  std::function<void()> act_;
};

/// While an SignalsBlocked lives, an ending from outside waits. Once that has begun, the
/// constructor waits for it and so does not return. The object guards work that is short and has to
/// be done whole, and files that must not appear while the last acts remove them.
class SignalsBlocked {
 public:
  SignalsBlocked();
  ~SignalsBlocked();
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
};

/// Not collective. Performs all last acts. Call it before MPI_Abort.
void performLastActs() noexcept;

/// Not collective. Performs all last acts and ends all ranks with exit code 1. It serves where an
/// exception would have to pass through the C code of a library; the caller has said why.
[[noreturn]] void abortRun() noexcept;

/// An Interrupted is thrown on all ranks together where a run that has been asked to stop does so.
/// It is no error, and so no exception of the standard library.
struct Interrupted {};

/// Not collective. Returns true once this rank has been asked to stop, by SIGTERM or SIGUSR1.
bool stopAsked();
/// Collective. Throws Interrupted on all ranks once one of them has been asked to stop.
void stopIfAsked(MPI_Comm comm);

/// Returns true once a rank has been asked to stop.
using StopAsked = std::function<bool()>;

/// Collective. Runs work(asked) on each rank apart from the others: the work makes no collective
/// calls, and may take longer on one rank than on another. It calls asked() at short intervals, at
/// little cost, and returns or throws Interrupted once that is true on any rank. Throws Interrupted
/// on all ranks if one has been asked to stop, else Error on all ranks if the work of one throws
/// it.
void workApart(MPI_Comm comm, const std::function<void(const StopAsked& asked)>& work);

/// A SignalWatch takes the signals that ask the program to end, as batch systems, mpirun and the
/// terminal send them. SIGUSR1, and SIGTERM where SIGKILL does not follow at once, ask the run to
/// stop where it can: stopAsked(). At the others (SIGINT, SIGHUP, …), and at a SIGTERM some seconds
/// after the first, a thread that waits for signals performs the last acts, says on rank 0 in one
/// line which signal it was, and ends the process by it. Signals that are ignored already
/// (nohup) stay ignored. A write to a closed pipe or beyond the limit of a file's size is an error
/// of that write alone.
class SignalWatch {
 public:
  /// Notes which signals are ignored, and whether mpirun has started the run. Make the object
  /// before MPI and PETSc start, which set variables and handlers of their own.
  SignalWatch();
  /// Takes the signals from here on. Call it after PETSc has started. Throws Error if no pipe can
  /// be made.
  void begin(int rank);

 private:
  unsigned long ignored_ = 0;  ///< a bit per signal
  bool hasTime_;               ///< after SIGTERM
};

}  // namespace squeal
