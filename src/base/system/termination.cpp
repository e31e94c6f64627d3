// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/termination.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "base/system/error.hpp"

namespace squeal {
namespace {

constexpr int endings[] = {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1, SIGUSR2};

/// Returns the mutex that is locked while handlers are registered or run, and while termination is
/// delayed. It is recursive because this work may fail and abort.
std::recursive_mutex& gate() {
  static std::recursive_mutex mutex;
  return mutex;
}

std::vector<const std::function<void()>*>& handlers() {
  static std::vector<const std::function<void()>*> list;
  return list;
}

int signalPipe[2] = {-1, -1};

/// Forwards the signal to the waiting thread. A signal handler must not do more: the interrupted
/// code may be using memory or holding a lock.
extern "C" void forwardSignal(int signal) {
  const unsigned char byte = signal;
  [[maybe_unused]] const auto written = write(signalPipe[1], &byte, 1);
}

/// Writes one line and ends this process by the signal; mpirun then ends the other ranks. The
/// handlers of MPI and PETSc allocate memory, and would hang if the heap is damaged. For the same
/// reason no termination handlers run.
extern "C" void reportCrash(int signal) {
  const auto print = [](const char* text) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
  };
  print("squeal: error: a defect of the program, or of a library, ended it by ");
  print(signal == SIGABRT   ? "SIGABRT"
        : signal == SIGSEGV ? "SIGSEGV"
        : signal == SIGBUS  ? "SIGBUS"
        : signal == SIGFPE  ? "SIGFPE"
                            : "SIGILL");
  print("; please report it with the options file\n");
  std::signal(signal, SIG_DFL);
  raise(signal);
}

constexpr int defects[] = {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

void installCrashHandlers() {
  // The stack itself may have overflowed.
  static unsigned char alternative[1 << 16];
  stack_t stack{};
  stack.ss_sp = alternative;
  stack.ss_size = sizeof alternative;
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_flags = SA_ONSTACK | SA_RESETHAND | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  action.sa_handler = reportCrash;
  for (int signal : defects) sigaction(signal, &action, nullptr);
}

std::atomic<bool> stop = false;

/// Returns false if SIGKILL follows SIGTERM before a run could stop: by default, mpirun of Open MPI
/// leaves its ranks one second.
bool hasTimeAfterSigterm() {
  if (!std::getenv("OMPI_COMM_WORLD_SIZE")) return true;
  const char* seconds = std::getenv("OMPI_MCA_odls_base_sigkill_timeout");
  return seconds && std::atoi(seconds) > 1;
}

/// Returns the next signal that ends the process; none if the pipe cannot be read.
std::optional<int> awaitEnding(int rank, bool hasTime) {
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> requestedAt;
  for (;;) {
    unsigned char signal = 0;
    while (read(signalPipe[0], &signal, 1) != 1)
      if (errno != EINTR) return {};
    const bool ends = signal == SIGTERM && !hasTime;
    if ((signal != SIGTERM && signal != SIGUSR1) || ends) return signal;
    // The batch system and mpirun may send the same request at nearly the same time. A later one
    // announces SIGKILL.
    if (signal == SIGTERM && requestedAt && Clock::now() - *requestedAt > std::chrono::seconds(5))
      return signal;
    if (!requestedAt) requestedAt = Clock::now();
    if (!stop.exchange(true) && rank == 0)
      std::fprintf(stderr, "squeal: signal %d (%s): the run stops as soon as it can\n", signal,
                   strsignal(signal));
  }
}

void awaitSignal(int rank, bool hasTime) {
  const auto ending = awaitEnding(rank, hasTime);
  if (!ending) return;
  const int signal = *ending;
  const std::lock_guard lock(gate());
  runTerminationHandlers();
  if (rank == 0)
    std::fprintf(stderr, "squeal: error: ended by signal %d (%s)\n", signal, strsignal(signal));
  std::signal(signal, SIG_DFL);
  raise(signal);
}

/// Shares a request to stop between ranks that work independently. The ranks count requests and
/// finished ranks in rounds, each a nonblocking sum over all ranks, until all are done or one has a
/// request.
class SharedStop {
 public:
  explicit SharedStop(MPI_Comm comm) : comm_(comm), size_(mpi::size(comm)) {
    if (size_ > 1) begin(false);
  }
  SharedStop(const SharedStop&) = delete;
  SharedStop& operator=(const SharedStop&) = delete;

  /// Not collective. Returns true once a request on any rank is known.
  bool requested() {
    if (stop || asked_) return true;
    if (over_ || size_ == 1) return false;
    constexpr std::chrono::milliseconds interval{20};
    if (const auto now = Clock::now(); now >= next_) {
      next_ = now + interval;
      int complete = 0;
      MPI_Test(&request_, &complete, MPI_STATUS_IGNORE);
      if (complete) end(false);
    }
    return asked_;
  }
  /// Collective. Waits for the other ranks. Returns true if a stop has been requested on any rank.
  bool join() {
    if (size_ == 1) return stop;
    while (!over_) {
      MPI_Wait(&request_, MPI_STATUS_IGNORE);
      end(true);
    }
    return asked_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  void begin(bool done) {
    own_[0] = stop, own_[1] = done;
    MPI_Iallreduce(own_, all_, 2, MPI_INT, MPI_SUM, comm_, &request_);
  }
  void end(bool done) {
    asked_ = all_[0] > 0;
    over_ = asked_ || all_[1] == size_;
    if (!over_) begin(done);
  }

  MPI_Comm comm_;
  int size_;
  MPI_Request request_ = MPI_REQUEST_NULL;
  int own_[2] = {}, all_[2] = {};  // number of requests, number done
  bool asked_ = false, over_ = false;
  Clock::time_point next_;
};

}  // namespace

AtTermination::AtTermination(std::function<void()> handler) : handler_(std::move(handler)) {
  const std::lock_guard lock(gate());
  handlers().push_back(&handler_);
}

AtTermination::~AtTermination() {
  const std::lock_guard lock(gate());
  std::erase(handlers(), &handler_);
}

SignalsBlocked::SignalsBlocked() { gate().lock(); }
SignalsBlocked::~SignalsBlocked() { gate().unlock(); }

void runTerminationHandlers() noexcept {
  const std::lock_guard lock(gate());
  for (const auto* handler : handlers()) try {
      (*handler)();
    } catch (...) {  // the process ends anyway; the next run removes the remains
    }
}

bool stopRequested() { return stop; }

void stopIfRequested(MPI_Comm comm) {
  if (mpi::any(comm, stop)) throw Interrupted();
}

bool completed(const std::function<void()>& work) try {
  work();
  return true;
} catch (const Interrupted&) {
  return false;
}

void workIndependently(MPI_Comm comm,
                       const std::function<void(const StopRequested& stopRequested)>& work) {
  SharedStop shared(comm);
  std::string failure;
  try {
    work([&] { return shared.requested(); });
  } catch (const Error& error) {
    failure = error.what();
  } catch (const Interrupted&) {  // join() returns true then
  }
  if (shared.join()) throw Interrupted();
  failTogether(comm, failure);
}

void abortRun() noexcept {
  runTerminationHandlers();
  MPI_Abort(MPI_COMM_WORLD, 1);
  _exit(1);
}

SignalWatch::SignalWatch() : hasTime_(hasTimeAfterSigterm()) {
  for (int signal : endings) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler == SIG_IGN) ignored_ |= 1UL << signal;
  }
}

void SignalWatch::begin(int rank) {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  if (pipe2(signalPipe, O_CLOEXEC) != 0)
    throw Error("cannot create a pipe for signals: " + std::string(std::strerror(errno)));
  std::thread(awaitSignal, rank, hasTime_).detach();
  gate(), handlers();                   // constructed first, they outlive the call at exit
  std::atexit(runTerminationHandlers);  // MPI calls exit() on a rank that has lost its mpirun
  installCrashHandlers();
  struct sigaction action {};
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (int signal : endings) {
    action.sa_handler = ignored_ & (1UL << signal) ? SIG_IGN : forwardSignal;
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace squeal
