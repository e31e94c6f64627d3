#include "base/output/lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "base/output/file.hpp"
#include "base/petsc/check.hpp"
#include "base/session/stages.hpp"
#include "base/system/regular_file.hpp"
#include "base/system/termination.hpp"

namespace squeal::output {
namespace {

/// Locks the file without waiting. Returns 0 or errno.
int lockFile(int file, int kind) {
  while (flock(file, kind | LOCK_NB) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

/// Returns false if another run has removed the file of this name, or put a new one in its place.
bool isStill(const std::filesystem::path& path, int file) {
  struct stat named {
  }, open{};
  return lstat(path.c_str(), &named) == 0 && fstat(file, &open) == 0 &&
         named.st_ino == open.st_ino && named.st_dev == open.st_dev;
}

}  // namespace

void Lock::take(MPI_Comm comm, const std::filesystem::path& folder, const std::string& head) {
  path_ = folder / name;
  check(MPI_Barrier(
      comm));  // every rank has let go of the lock that this run may have had there before
  std::string warning;
  onFirstRank(comm, head, [&] { takeAlone(folder, warning); });
  if (!warning.empty()) complain(comm, warning);
  int rank = 0, held = state_ == State::held;
  check(MPI_Comm_rank(comm, &rank));
  check(MPI_Bcast(&held, 1, MPI_INT, 0, comm));
  if (rank != 0 && held) join();
}

/// Takes the lock exclusively at first, which tells that no other run has it, and then shared, for
/// the other ranks to join. Sets `warning` where the file system cannot lock. Throws Error or
/// WriteError as take() throws Error.
void Lock::takeAlone(const std::filesystem::path& folder, std::string& warning) {
  const SignalsBlocked whole;
  for (int attempt = 0; attempt < 10;
       ++attempt) {  // a run that ends at this moment takes its file with it
    const int file = openRegular(path_, O_RDWR | O_CREAT, cannotWrite(path_, 0));
    int error = lockFile(file, LOCK_EX);
    const bool gone = error == 0 && !isStill(path_, file);
    if (error == 0 && !gone) error = lockFile(file, LOCK_SH);
    if (error == 0 && !gone) {
      file_ = file;
      state_ = State::held;
      return;
    }
    close(file);
    if (error == EWOULDBLOCK) break;
    if (gone) continue;
    unlink(path_.c_str());
    state_ = State::unlockable;
    warning = "the folder " + folder.string() + " cannot be locked (" + std::strerror(error) +
              "): nothing keeps another run from writing there at the same time";
    return;
  }
  throw WriteError("another run is writing to " + folder.string() +
                   ": wait for its end, or name another folder");
}

/// Joins rank 0, which holds the lock already. If that fails, as on a node that does not see the
/// folder, the run has the lock all the same.
void Lock::join() {
  const SignalsBlocked whole;
  const int file = open(path_.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return;
  if (lockFile(file, LOCK_SH) == 0) {
    file_ = file;
    state_ = State::held;
  } else
    close(file);
}

void Lock::release(const std::function<void()>& asLast, std::chrono::milliseconds patience) {
  if (state_ == State::unlockable) asLast();
  if (state_ == State::held) {
    // The rank that can have it alone is the last one. The attempt gives up the shared lock.
    constexpr std::chrono::milliseconds pause(10);
    int error = lockFile(file_, LOCK_EX);
    for (; error == EWOULDBLOCK && patience.count() > 0; patience -= pause) {
      std::this_thread::sleep_for(pause);
      error = lockFile(file_, LOCK_EX);
    }
    if (error == 0 && isStill(path_, file_)) {
      asLast();
      unlink(path_.c_str());
    }
    close(file_);
  }
  state_ = State::none;
}

}  // namespace squeal::output
