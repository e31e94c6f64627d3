// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/child.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>

#include "base/system/child_work.hpp"
#include "base/system/error.hpp"
#include "base/system/installation.hpp"
#include "base/system/text.hpp"

namespace squeal {
namespace {

/// A file descriptor that is closed with the object.
struct OpenFile {
  int number;
  ~OpenFile() { close(number); }
};

/// A child process and the reading end of the pipe from it. The destructor kills the child.
class Child {
 public:
  /// Starts `body(pipe)` in the child, which must not return.
  template <class Body>
  Child(const std::string& subject, const Body& body);
  ~Child() {
    if (id_ > 0) kill(id_, SIGKILL), wait();
    close(pipe_);
  }
  Child(const Child&) = delete;
  int wait() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) continue;
    id_ = 0;
    return status;
  }
  /// Reads `count` bytes. Returns false if there are fewer.
  bool take(void* to, std::size_t count) const {
    for (char* at = static_cast<char*>(to); count > 0;) {
      const ssize_t got = read(pipe_, at, count);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      at += got, count -= got;
    }
    return true;
  }

 private:
  pid_t id_ = 0;
  int pipe_ = -1;
};

template <class Body>
Child::Child(const std::string& subject, const Body& body) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw Error(subject + ": cannot create a pipe to a child process: " + std::strerror(errno));
  const pid_t parent = getpid(), id = fork();
  if (id == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    resetSignals();
    body(ends[1]);
  }
  close(ends[1]);
  if (id < 0) {
    close(ends[0]);
    throw Error(subject + ": cannot start a child process: " + std::strerror(errno));
  }
  id_ = id, pipe_ = ends[0];
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

/// Returns the result of the child. Throws Error if it has none. `file` is the file of its program;
/// empty for a function.
std::vector<char> resultOf(Child& child, const ChildLimits& limits, const std::string& file) {
  Outcome outcome{};
  std::size_t count = 0;
  std::vector<char> result;
  bool whole = child.take(&outcome, 1) && child.take(&count, sizeof count);
  if (whole) {
    result.resize(count);
    whole = child.take(result.data(), count);
  }
  const int status = child.wait();
  const std::string head = limits.subject + ": ";
  constexpr int notLoaded = 127;  // of the dynamic linker, which has printed the reason
  if (!whole && !file.empty() && WIFEXITED(status) && WEXITSTATUS(status) == notLoaded)
    throw Error(head + "the program '" + file + "' cannot be loaded: its libraries are incomplete");
  if (!whole) throw Error(head + endOf(status, limits));
  if (outcome == Outcome::noMemory) throw Error(head + limits.noMemory);
  if (outcome == Outcome::failure) throw Error(std::string(result.begin(), result.end()));
  if (outcome == Outcome::notStarted) {
    int error = 0;
    Stream(std::move(result))(error);
    throw Error(head + "cannot start the program '" + file + "': " + std::strerror(error));
  }
  return result;
}

/// Returns a file in memory with these bytes, to read from its beginning.
int fileOf(const std::vector<char>& bytes, const std::string& subject) {
  const int file = memfd_create("squeal job", MFD_CLOEXEC);
  if (file >= 0 && write(file, bytes.data(), bytes.size()) == std::ssize(bytes) &&
      lseek(file, 0, SEEK_SET) == 0)
    return file;
  const int error = errno;
  if (file >= 0) close(file);
  throw Error(subject + ": cannot pass a job to a child process: " + std::strerror(error));
}

/// Replaces the process by a program that reads the job and writes to the pipe. It inherits the
/// standard error output, and no other file. After fork() of a process with threads only calls of
/// the system are safe.
[[noreturn]] void replaceProcess(const char* file, int job, int pipe) {
  job = fcntl(job, F_DUPFD, 3);  // the numbers 0 to 2 may be free
  pipe = fcntl(pipe, F_DUPFD, 3);
  dup2(job, 0);
  dup2(pipe, 1);
  if (fcntl(2, F_GETFD) < 0) open("/dev/null", O_WRONLY);
#ifdef SYS_close_range
  syscall(SYS_close_range, 3u, ~0u, 0u);
#endif
  char* const arguments[] = {const_cast<char*>(file), nullptr};
  execv(file, arguments);
  const int error = errno;
  answer(1, Outcome::notStarted, reinterpret_cast<const char*>(&error), sizeof error);
  _exit(1);
}

}  // namespace

std::vector<char> inChild(const ChildLimits& limits, const ChildWork& work) {
  Child child(limits.subject, [&](int pipe) {
    closeOutputs();
    workAndExit(pipe, limits, work);
  });
  return resultOf(child, limits, "");
}

std::vector<char> inProgram(const std::string& name, const ChildLimits& limits,
                            const std::vector<char>& job) {
  std::string file;
  try {
    file = installedProgram(name);
  } catch (const Error& error) {
    throw Error(limits.subject + ": " + error.what());
  }
  const OpenFile input{fileOf(Assignment::bytes(limits, job), limits.subject)};
  Child child(limits.subject, [&](int pipe) { replaceProcess(file.c_str(), input.number, pipe); });
  return resultOf(child, limits, file);
}

}  // namespace squeal
