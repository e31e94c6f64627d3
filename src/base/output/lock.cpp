// SPDX-License-Identifier: BSD-2-Clause
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

/// Returns false if another run has removed the file of this name, or replaced it.
bool isStill(const std::filesystem::path& path, int file) {
  struct stat named {
  }, open{};
  return lstat(path.c_str(), &named) == 0 && fstat(file, &open) == 0 &&
         named.st_ino == open.st_ino && named.st_dev == open.st_dev;
}

}  // namespace

void Lock::acquire(MPI_Comm comm, const std::filesystem::path& folder, const std::string& head) {
  path_ = folder / name;
  check(MPI_Barrier(comm));  // all ranks have released an earlier lock of this run
  std::string warning;
  onFirstRank(comm, head, [&] { lockExclusively(folder, warning); });
  if (!warning.empty()) printWarning(comm, warning);
  bool held = state_ == State::held;
  mpi::broadcast(comm, held);
  if (mpi::rank(comm) != 0 && held) join();
}

/// Takes the lock exclusively at first, which shows that no other run has it, and then shared, so
/// that the other ranks can join. Sets `warning` if the file system cannot lock. Throws Error or
/// WriteError in the cases of acquire().
void Lock::lockExclusively(const std::filesystem::path& folder, std::string& warning) {
  const SignalsBlocked whole;
  // A run that ends at this moment removes its file, so try several times.
  for (int attempt = 0; attempt < 10; ++attempt) {
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
              "): another run could write there at the same time";
    return;
  }
  throw WriteError("another run is writing to " + folder.string() +
                   ": wait until it ends, or name another folder");
}

/// Shares the lock of rank 0. If that fails, for example on a node that does not see the folder,
/// the run still has the lock.
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
    // Only the last rank can lock exclusively. The attempt releases the shared lock.
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
