#pragma once
/// A folder whose content is replaced as a whole: what lies there is always one complete run, or
/// nothing that looks like one.
#include <mpi.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "output/lock.hpp"
#include "output/manifest.hpp"
#include "petsc/termination.hpp"

namespace squeal::output {

/// The names of the files in a folder.
struct Naming {
  std::string option;  ///< the option that names the folder, with its dash, for messages
  std::string last;    ///< the file whose presence shows that all others are there
  /// Returns true if a run may write this path, relative to the folder: a file or a subfolder.
  std::function<bool(const std::filesystem::path&)> mayWrite;
  /// Returns the files that a version without manifests left in a folder; none if it holds no
  /// results of such a version.
  std::function<Manifest(const std::filesystem::path&)> former;
};

/// Files are written to staging() and replace those of the earlier run when all are complete; of
/// the earlier run is what its manifest lists. Every way out but commit() leaves the folder as it
/// was: errors, signals, MPI_Abort; after SIGKILL the next run does it.
///
/// commit() has one moment, the renaming of .partial to .complete, before which the earlier results
/// stand and after which the new ones are what a next run would finish putting in place. From then
/// on: the earlier run's `last` goes first, then its other files, its manifest at the end; the new
/// files are renamed into the folder, then the manifest, and `last` as the very last.
class Folder {
 public:
  /// Collective. Makes the folder if need be and locks it; finishes the commit of a run that was
  /// killed in it, and removes the files that such a run left. Throws Error if the folder cannot be
  /// written, if another run is writing to it, or if a file that belongs to no run has a name that
  /// this run may write.
  Folder(MPI_Comm comm, Naming naming, std::filesystem::path path);
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Where files are written until commit().
  const std::filesystem::path& staging() const { return staging_; }
  /// Collective. Makes the staging folder. Throws Error if it cannot be made.
  void stage();
  /// Collective. Call it after all ranks have written. Throws Error if a file of the user is in the
  /// way, or if the disc is full; the earlier results then stay.
  void commit();

 private:
  template <class Action>
  void onFirst(const Action& action) const;
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
  /// How many of the last folders of the path had to be made, this one and its parents
  int made_ = 0;
  Lock lock_;
  std::unique_ptr<LastAct> lastAct_;
};

}  // namespace squeal::output
