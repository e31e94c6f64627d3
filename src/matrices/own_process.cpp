#include "matrices/own_process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "petsc/check.hpp"
#include "petsc/text.hpp"

namespace squeal::matrices {
namespace {

/// One end of a pipe.
class End {
 public:
  explicit End(int descriptor) : descriptor_(descriptor) {}
  ~End() { close(); }
  End(const End&) = delete;
  End& operator=(const End&) = delete;
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }
  /// False if the other end does not live.
  bool write(const void* from, std::size_t count) const {
    for (auto* bytes = static_cast<const char*>(from); count > 0;) {
      const ssize_t done = ::write(descriptor_, bytes, count);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return false;
      bytes += done, count -= static_cast<std::size_t>(done);
    }
    return true;
  }
  bool read(void* to, std::size_t count) const {
    for (auto* bytes = static_cast<char*>(to); count > 0;) {
      const ssize_t done = ::read(descriptor_, bytes, count);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return false;
      bytes += done, count -= static_cast<std::size_t>(done);
    }
    return true;
  }

 private:
  int descriptor_;
};

/// What goes through the pipe: these, then the message, or rows, columns and values of the entries.
struct Head {
  bool failed = false;
  PetscInt rows = 0, columns = 0;
  std::size_t length = 0;  ///< of the message, or of each list
};

template <class List>
std::size_t bytesOf(const List& list) {
  return list.size() * sizeof list[0];
}

bool send(const End& pipe, const Entries& entries) {
  const Head head{false, entries.rows, entries.columns, entries.value.size()};
  return pipe.write(&head, sizeof head) && pipe.write(entries.row.data(), bytesOf(entries.row)) &&
         pipe.write(entries.column.data(), bytesOf(entries.column)) && pipe.write(entries.value.data(), bytesOf(entries.value));
}

bool sendFailure(const End& pipe, const std::string& message) {
  const Head head{true, 0, 0, message.size()};
  return pipe.write(&head, sizeof head) && pipe.write(message.data(), message.size());
}

/// The child ends where it crashes: without the words of PETSc, which would end all ranks, of the C library, and without a core file.
void becomeSilent() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT}) std::signal(signal, SIG_DFL);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__)  // whose reports are wanted
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, 2);
#endif
}

[[noreturn]] void work(const End& pipe, const std::function<Entries()>& read) {
  becomeSilent();
  bool sent = false;
  try {
    sent = send(pipe, read());
  } catch (const std::bad_alloc&) {
    sent = sendFailure(pipe, "not enough memory");
  } catch (const std::exception& error) {
    sent = sendFailure(pipe, error.what());
  }
  _exit(sent ? 0 : 1);
}

/// False if the child ends before all has come. Error: what the child reports.
bool receive(const End& pipe, Entries& entries) {
  Head head;
  if (!pipe.read(&head, sizeof head)) return false;
  if (head.failed) {
    std::string message(head.length, '\0');
    if (!pipe.read(message.data(), message.size())) return false;
    throw Error(message);
  }
  entries.rows = head.rows;
  entries.columns = head.columns;
  entries.row.resize(head.length);
  entries.column.resize(head.length);
  entries.value.resize(head.length);
  return pipe.read(entries.row.data(), bytesOf(entries.row)) && pipe.read(entries.column.data(), bytesOf(entries.column)) &&
         pipe.read(entries.value.data(), bytesOf(entries.value));
}

/// Waits for the child on every way out.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() { wait(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  /// How it ended.
  std::string wait() {
    int status = 0;
    while (id_ > 0 && waitpid(id_, &status, 0) < 0 && errno == EINTR) continue;
    id_ = -1;
    return WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : formatted("exit code %d", WEXITSTATUS(status));
  }

 private:
  pid_t id_;
};

}  // namespace

Entries inOwnProcess(const char* library, const std::function<Entries()>& read) {
  int ends[2] = {-1, -1};
  if (pipe(ends) != 0) throw Error(formatted("no pipe: %s", std::strerror(errno)));
  const End out(ends[0]);
  End in(ends[1]);
  const pid_t id = fork();
  if (id < 0) throw Error(formatted("no process to read it in: %s", std::strerror(errno)));
  if (id == 0) work(in, read);
  Child child(id);
  in.close();  // so that the end of the child is the end of what comes
  Entries entries;
  if (receive(out, entries)) return entries;
  throw Error(formatted("the file is damaged: %s crashes on it (%s)", library, child.wait().c_str()));
}

}  // namespace squeal::matrices
