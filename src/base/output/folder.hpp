#pragma once
/// A folder is replaced as a whole: there is always one complete run in it, or nothing that looks
/// like one.
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

/// The names of the files in a folder.
struct Naming {
  std::string option;  ///< the option that names the folder, with its dash, for messages
  std::string last;    ///< the file whose presence shows that all others are there
  /// Returns true if a run may write this path, relative to the folder: a file or a subfolder.
  std::function<bool(const std::filesystem::path&)> mayWrite;
  /// Files whose presence marks a folder as one of ours, beside the manifest and what a killed run
  /// leaves; relative to the folder.
  std::vector<std::filesystem::path> marks = {};
  /// Files that this run has opened already, and that may lie in the folder.
  std::vector<std::filesystem::path> opened = {};
  bool ofCase = false;  ///< a case names the folder, so that it may hold anything
  bool inside = false;  ///< it is a subfolder of one of ours, and no link may lead out of that
};

/// A Folder takes the files of a run in staging(); they replace those of the earlier run when all
/// are complete. The files that the manifest lists are those of the earlier run. Every way out but
/// commit() leaves the folder as it was: errors, signals and MPI_Abort; after SIGKILL the next run
/// puts it in order.
///
/// The renaming of .partial to .complete is the one moment of commit(). Before it the earlier
/// results stand, and after it the next run would finish to put the new ones into place. From then
/// on the earlier run's `last` goes first, then its other files, and its manifest at the end. The
/// new files are then renamed into the folder, then the manifest, and `last` as the very last.
class Folder {
 public:
  /// Collective. Makes the folder if need be and locks it; finishes the commit of a run that was
  /// killed in it, and removes the files that such a run left. Throws Error if the folder may not
  /// be taken (claim.hpp) or cannot be written, if another run is writing to it, or if a file that
  /// belongs to no run has a name that this run may write.
  Folder(MPI_Comm comm, Naming naming, std::filesystem::path path);
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Returns the folder in which files are written until commit(), borrowed.
  const std::filesystem::path& staging() const { return staging_; }
  /// Collective. Makes the staging folder. Throws Error if it cannot be made.
  void stage();
  /// Collective. Puts the new files into the place of the earlier ones. Call it after all ranks
  /// have written. Throws Error if a file of the user is in the way, or if the disc is full. The
  /// earlier results stay if that happens before the renaming; after it, the next run puts the new
  /// ones into place.
  void commit();
  /// Collective. Removes the files of the earlier run, and the folder if it is empty then.
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
  /// Number of the last folders of the path that had to be made, this one and its parents
  int made_ = 0;
  Lock lock_;
  std::unique_ptr<AtTermination> lastAct_;
};

}  // namespace squeal::output
