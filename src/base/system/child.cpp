// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include "base/system/error.hpp"
#include "base/system/memory.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

constexpr unsigned patience = 30;  // s, until a line reports that the child is still running

enum class Outcome : char { result, failure, noMemory };

void limit(decltype(RLIMIT_AS) resource, double value) {
  rlimit now{};
  if (getrlimit(resource, &now) != 0) return;
  const rlim_t wanted = value;
  now.rlim_cur = std::min(now.rlim_cur, wanted);
  setrlimit(resource, &now);
}

void writeAll(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;  // the parent has died, or will notice the missing bytes
    bytes += written, count -= written;
  }
}

void answer(int pipe, Outcome outcome, const char* bytes, std::size_t count) {
  writeAll(pipe, reinterpret_cast<const char*>(&outcome), 1);
  writeAll(pipe, reinterpret_cast<const char*>(&count), sizeof count);
  writeAll(pipe, bytes, count);
}

char runningText[512];  // a signal handler can only write a text that exists already
int errorOutput = 2;

void reportStillRunning(int) {
  [[maybe_unused]] const auto written = write(errorOutput, runningText, std::strlen(runningText));
}

/// Does the work in the child process and exits. It does not flush, finalise or handle anything
/// that belongs to the parent.
[[noreturn]] void serve(int pipe, pid_t parent, const ChildLimits& limits, const ChildWork& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  for (int number = 1; number < NSIG; ++number)
    signal(number, SIG_DFL);  // PETSc's handlers would print a traceback
  // mpirun signals the whole process group; the parent decides how the run stops.
  for (const int number : {SIGTERM, SIGUSR1}) signal(number, SIG_IGN);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, addressSpace() + limits.memoryBytes);
  if (limits.processorSeconds) limit(RLIMIT_CPU, std::ceil(*limits.processorSeconds));
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  errorOutput = fcntl(2, F_DUPFD_CLOEXEC, 3);
  for (int file : {0, 1, 2})
    dup2(nowhere, file);  // the program reports a crash itself, without the C library's lines
  std::snprintf(runningText, sizeof runningText, "squeal: %s: %s has been running for %u s\n",
                limits.subject.c_str(), limits.program.c_str(), patience);
  signal(SIGALRM, reportStillRunning);
  alarm(patience);
  try {
    const std::vector<char> result = work([&](const std::string& text) {
      dprintf(errorOutput, "squeal: warning: %s\n", escaped(text).c_str());
    });
    answer(pipe, Outcome::result, result.data(), result.size());
  } catch (const std::bad_alloc&) {
    answer(pipe, Outcome::noMemory, "", 0);
  } catch (const std::length_error&) {  // a vector longer than the address space
    answer(pipe, Outcome::noMemory, "", 0);
  } catch (const std::exception& error) {
    const std::string text = error.what();
    answer(pipe, Outcome::failure, text.data(), text.size());
  }
  _exit(0);
}

/// The reading end of the pipe from a child process. The destructor kills the child.
struct Child {
  pid_t id;
  int pipe;
  ~Child() {
    if (id > 0) kill(id, SIGKILL), wait();
    close(pipe);
  }
  int wait() {
    int status = 0;
    while (waitpid(id, &status, 0) < 0 && errno == EINTR) continue;
    id = 0;
    return status;
  }
  /// Reads `count` bytes. Returns false if there are fewer.
  bool take(void* to, std::size_t count) const {
    for (char* at = static_cast<char*>(to); count > 0;) {
      const ssize_t got = read(pipe, at, count);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      at += got, count -= got;
    }
    return true;
  }
};

Child start(const ChildLimits& limits, const ChildWork& work) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw Error(limits.subject +
                ": cannot create a pipe to a child process: " + std::strerror(errno));
  const pid_t parent = getpid(), id = fork();
  if (id == 0) serve(ends[1], parent, limits, work);
  close(ends[1]);
  if (id < 0) {
    close(ends[0]);
    throw Error(limits.subject + ": cannot start a child process: " + std::strerror(errno));
  }
  return {id, ends[0]};
}

std::string endOf(int status, const ChildLimits& limits) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return formatted("%s has not finished after %.0f s of processor time", limits.program.c_str(),
                     std::ceil(limits.processorSeconds.value_or(0)));
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
    return limits.program + " was killed, perhaps for lack of memory";
  if (WIFSIGNALED(status))  // some libraries crash if an allocation fails
    return limits.program + " crashed (" + std::string(strsignal(WTERMSIG(status))) + "), or " +
           limits.noMemory;
  return limits.program + " exited with code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

std::vector<char> inChild(const ChildLimits& limits, const ChildWork& work) {
  Child child = start(limits, work);
  Outcome outcome{};
  std::size_t count = 0;
  std::vector<char> result;
  bool whole = child.take(&outcome, 1) && child.take(&count, sizeof count);
  if (whole) {
    result.resize(count);
    whole = child.take(result.data(), count);
  }
  const int status = child.wait();
  if (!whole) throw Error(limits.subject + ": " + endOf(status, limits));
  if (outcome == Outcome::noMemory) throw Error(limits.subject + ": " + limits.noMemory);
  if (outcome == Outcome::failure) throw Error(std::string(result.begin(), result.end()));
  return result;
}

}  // namespace squeal
