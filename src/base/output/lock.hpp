// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A lock that admits one run at a time to a folder.
#include <mpi.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

namespace squeal::output {

/// An advisory lock (flock) on a file in a folder. All ranks of a run share the lock, so it lasts
/// until the last rank has ended, in whatever way. A lock file left behind by a killed process is
/// ignored.
class Lock {
 public:
  /// The name of the file.
  static constexpr const char* name = ".squeal.lock";

  Lock() = default;
  ~Lock() { release(); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  /// Collective. Takes the lock. Throws Error on all ranks, with a message that begins with `head`,
  /// if another run has the lock or the file cannot be created. Issues a warning if the file system
  /// cannot lock.
  void acquire(MPI_Comm comm, const std::filesystem::path& folder, const std::string& head);
  /// Not collective. Releases the lock. The last rank to do so first calls `asLast` and removes the
  /// file. Each of the other ranks waits up to `patience` for the last rank to finish, and acts in
  /// its place if it dies meanwhile.
  void release(
      const std::function<void()>& asLast = [] {}, std::chrono::milliseconds patience = {});

 private:
  enum class State {
    none,
    held,
    unlockable  ///< the file system cannot lock; only rank 0 has this state, and it acts as the
                ///< last rank
  };
  void lockExclusively(const std::filesystem::path& folder, std::string& warning);
  void join();

  std::filesystem::path path_;
  int file_ = -1;
  State state_ = State::none;
};

}  // namespace squeal::output
