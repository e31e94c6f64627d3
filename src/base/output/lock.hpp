#pragma once
/// This lock admits one run at a time to a folder.
#include <mpi.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

namespace squeal::output {

/// A Lock is an advisory lock (flock) on a file in a folder. Every rank of a run holds it, so that
/// it lasts until the last of them is gone, however it ends. A file that SIGKILL leaves behind
/// locks nothing.
class Lock {
 public:
  /// The name of the file.
  static constexpr const char* name = ".squeal.lock";

  Lock() = default;
  ~Lock() { release(); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  /// Collective. Takes the lock. Throws Error on all ranks, with a message that begins with `head`,
  /// if another run holds the lock or the file cannot be made. Where the file system cannot lock, a
  /// warning says so.
  void take(MPI_Comm comm, const std::filesystem::path& folder, const std::string& head);
  /// Not collective. Releases the lock. The last rank to let go does `asLast` first and removes the
  /// file. The others wait for it as long as `patience`, and take its part if it dies meanwhile.
  void release(
      const std::function<void()>& asLast = [] {}, std::chrono::milliseconds patience = {});

 private:
  enum class State {
    none,
    held,
    unlockable
  };  ///< unlockable: only on rank 0, which is then the last one
  void takeAlone(const std::filesystem::path& folder, std::string& warning);
  void join();

  std::filesystem::path path_;
  int file_ = -1;
  State state_ = State::none;
};

}  // namespace squeal::output
