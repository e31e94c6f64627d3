#pragma once
/// One run at a time in a folder.
#include <mpi.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

namespace squeal::output {

/// An advisory lock (flock) on a file in a folder, held by every rank of a run, so that it lasts
/// until the last of them is gone, however it ends. One that is left behind by SIGKILL locks
/// nothing.
class Lock {
 public:
  /// The name of the file.
  static constexpr const char* name = ".squeal.lock";

  Lock() = default;
  ~Lock() { release(); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  /// Collective. Error, on all ranks, that begins with `head`: another run holds the lock, or the
  /// file cannot be made. Where the file system cannot lock, a warning says so.
  void take(MPI_Comm comm, const std::filesystem::path& folder, const std::string& head);
  /// Not collective. The last rank to let go does `asLast` first and removes the file. The others
  /// do not wait for it, or as long as `patience`, and take its part should it die.
  void release(
      const std::function<void()>& asLast = [] {}, std::chrono::milliseconds patience = {});

 private:
  enum class State {
    none,
    held,
    unlockable
  };  ///< unlockable: on rank 0, which is the last one then
  void takeAlone(const std::filesystem::path& folder, std::string& warning);
  void join();

  std::filesystem::path path_;
  int file_ = -1;
  State state_ = State::none;
};

}  // namespace squeal::output
