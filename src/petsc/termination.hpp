#pragma once
/// Endings from outside: signals, MPI_Abort after an error of a library, exit() in one. What a run
/// must not leave behind is put away all the same.
#include <functional>

namespace squeal {

/// Work that an ending from outside finds to be done, while the object lives. On a normal way out
/// the owner does it himself.
class LastAct {
 public:
  /// `act` runs in a thread of its own, beside whatever the run is doing, and may not call MPI.
  explicit LastAct(std::function<void()> act);
  ~LastAct();
  LastAct(const LastAct&) = delete;
  LastAct& operator=(const LastAct&) = delete;

 private:
  std::function<void()> act_;
};

/// While one lives, an ending from outside waits; once that has begun, none comes to life. For work
/// that is short and to be done whole, and for files that must not appear while the last acts
/// remove them.
class EndingWaits {
 public:
  EndingWaits();
  ~EndingWaits();
  EndingWaits(const EndingWaits&) = delete;
  EndingWaits& operator=(const EndingWaits&) = delete;
};

/// Does all last acts; before MPI_Abort.
void performLastActs() noexcept;

/// Signals that ask the program to end, as batch systems, mpirun and the terminal send them
/// (SIGTERM, SIGINT, SIGHUP, …), but not those ignored already (nohup). A thread that waits for
/// them performs the last acts, says on rank 0 which one it was in one line, and ends the process
/// by it. A write to a closed pipe or beyond the limit of a file's size is an error of that write
/// alone.
class SignalWatch {
 public:
  /// Before PETSc, which has handlers of its own, starts: notes what is ignored.
  SignalWatch();
  /// After PETSc has started.
  void begin(int rank);

 private:
  unsigned long ignored_ = 0;  ///< a bit per signal
};

}  // namespace squeal
