// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Replaces the results in a folder as a whole: the folder always contains the results of one
/// complete run, or nothing that could be mistaken for them.
#include <mpi.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/output/lock.hpp"
#include "base/output/manifest.hpp"
#include "base/system/termination.hpp"

namespace squeal::output {

/// The folder of the results, and the names of its files.
struct Naming {
  std::string option;  ///< the option that names the folder, with its dash, for messages
  std::string last;    ///< the file whose presence shows that the others are complete
  /// Returns true if a run may write this path, relative to the folder: a file or a subfolder.
  std::function<bool(const std::filesystem::path&)> mayWrite;
  /// Files, relative to the folder, whose presence marks the folder as one of this program. Its
  /// manifest and the remains of a killed run mark it too.
  std::vector<std::filesystem::path> marks = {};
  /// Files that this run has already opened, and that may be in the folder.
  std::vector<std::filesystem::path> opened = {};
  bool ofCase = false;  ///< a case names the folder, so it may contain anything
  bool inside = false;  ///< the folder is in a folder of this program, and must not be a link
};

/// A run writes its files to staging(); once all are complete, they replace those of the earlier
/// run, which the manifest lists. Without commit() the folder stays as it was, even after errors,
/// signals and MPI_Abort; after SIGKILL the next run restores it.
///
/// commit() takes effect when it renames .partial to .complete. If the run is killed before this,
/// the earlier results stay; if it is killed later, the next run completes the replacement. The
/// replacement first removes the file `last` of the earlier run, then its other files, then its
/// manifest. After that it moves the new files into the folder, then the new manifest, and finally
/// the new file `last`.
class Folder {
 public:
  /// Collective. Creates the folder if necessary and locks it. Completes the interrupted commit of
  /// a killed run and removes the remains of that run. Throws Error if this run cannot write to the
  /// folder or must not (claim.hpp), if another run is writing to it, or if a file that belongs to
  /// no run has a name that this run may write.
  Folder(MPI_Comm comm, Naming naming, std::filesystem::path path);
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Returns the folder to which the run writes its files until commit(); borrowed.
  const std::filesystem::path& staging() const { return staging_; }
  /// Collective. Creates the staging folder. Throws Error if it cannot be created.
  void stage();
  /// Collective. Replaces the earlier files by the new ones. Call it after all ranks have written.
  /// Throws Error if a file of the user is in the way, or if the disk is full. The earlier results
  /// then stay if .partial has not been renamed yet; otherwise the next run moves the new ones into
  /// place.
  void commit();
  /// Collective. Removes the files of the earlier run. The destructor then removes the folder if it
  /// is empty.
  void discard();

 private:
  template <class Action>
  void onFirst(const Action& action) const;
  void requireOurs() const;
  void make();
  void clear();
  void tidy(std::chrono::milliseconds patience = {});
  Manifest earlier() const;
  void requireFree(const std::function<bool(const std::filesystem::path&)>& writes,
                   const Manifest& ours, const std::filesystem::path& inside = {}) const;
  void replace() const;

  MPI_Comm comm_;
  Naming naming_;
  std::string head_;
  std::filesystem::path path_, staging_, complete_;
  /// Number of folders at the end of the path that this run has created
  int made_ = 0;
  Lock lock_;
  std::unique_ptr<AtTermination> removal_;  // removes the remains on termination
};

}  // namespace squeal::output
