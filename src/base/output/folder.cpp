// SPDX-License-Identifier: BSD-2-Clause
#include "base/output/folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <vector>

#include "base/output/claim.hpp"
#include "base/output/file.hpp"
#include "base/petsc/check.hpp"
#include "base/system/regular_file.hpp"

namespace squeal::output {

namespace fs = std::filesystem;

namespace {

/// Returns true for a folder itself, not for a link to one.
bool isFolder(const fs::path& path) { return fs::is_directory(fs::symlink_status(path)); }

std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  return names;
}

/// Time that the other ranks wait on termination while the last one removes files: mpirun kills all
/// ranks as soon as one has ended. mpirun itself waits no longer.
constexpr std::chrono::milliseconds patience(1000);

std::string inTheWay(const fs::path& path) {
  return path.string() + " is in the way: it does not belong to an earlier run (listed in " +
         Manifest::name + "); move it, or name another folder";
}

/// Renames a file or a folder, but never replaces an existing one. Throws WriteError.
void moveTo(const fs::path& from, const fs::path& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
  if (errno == EINVAL || errno == ENOSYS) {  // a file system without that flag, such as NFS
    if (fs::exists(fs::symlink_status(to)))
      errno = EEXIST;
    else if (std::rename(from.c_str(), to.c_str()) == 0)
      return;
  }
  const std::string reason = errno == EEXIST ? inTheWay(to) : cannotWrite(to, errno);
  throw WriteError(reason + "; the new results are complete in " + from.parent_path().string() +
                   ", and the next run moves them into place");
}

void moveAll(const fs::path& from, const fs::path& to,
             const std::function<bool(const fs::path&)>& later) {
  for (const auto& name : entriesOf(from)) {
    if (later(name)) continue;
    if (isFolder(from / name) && isFolder(to / name)) {
      moveAll(from / name, to / name, [](const auto&) { return false; });
      fs::remove(from / name);
    } else
      moveTo(from / name, to / name);
  }
}

/// Removes the listed files, `first` before and the manifest after all others, and then the empty
/// folders. Removes nothing through a folder that has become a link, since it leads elsewhere.
void removeListed(const fs::path& folder, const Manifest& manifest, const fs::path& first) {
  std::set<fs::path> real{""};
  for (const auto& inside : manifest.folders())  // parents precede their contents
    if (real.contains(inside.parent_path()) && isFolder(folder / inside)) real.insert(inside);
  const auto removeFile = [&](const fs::path& file) {
    // A folder in the place of a file belongs to the user.
    if (unlink((folder / file).c_str()) != 0 && errno != ENOENT && errno != EISDIR &&
        errno != EPERM)
      throw WriteError(cannotWrite(folder / file, errno));
  };
  if (manifest.files().contains(first)) removeFile(first);
  for (const auto& file : manifest.files())
    if (real.contains(file.parent_path()) && file != Manifest::name) removeFile(file);
  for (auto inside = real.rbegin(); inside != real.rend(); ++inside)
    if (!inside->empty())
      rmdir((folder / *inside).c_str());  // fails if it contains files of the user
  sync(folder);
  removeFile(Manifest::name);
}

/// Throws WriteError if the folder contains anything except folders and regular files.
void requireRegularFiles(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!isFolder(entry.path()))
      if (const std::string why = whyNotRegular(entry.path()); !why.empty()) throw WriteError(why);
}

/// Returns true if a folder of an earlier run contains files that do not belong to that run.
bool hasOtherFiles(const fs::path& folder, const fs::path& inside, const Manifest& ours) {
  for (const auto& name : entriesOf(folder / inside)) {
    const fs::path path = inside / name;
    const bool listed = isFolder(folder / path)
                            ? ours.folders().contains(path) && !hasOtherFiles(folder, path, ours)
                            : ours.files().contains(path);
    if (!listed) return true;
  }
  return false;
}

}  // namespace

template <class Action>
void Folder::onFirst(const Action& action) const {
  onFirstRank(comm_, head_, [&] {
    try {
      action();
    } catch (const fs::filesystem_error& error) {
      throw WriteError(cannotWrite(error.path1(), error.code().value()));
    }
  });
}

Folder::Folder(MPI_Comm comm, Naming naming, fs::path path)
    : comm_(comm),
      naming_(std::move(naming)),
      head_("option " + naming_.option + ": "),
      path_(path.has_filename() || path == path.root_path() ? std::move(path) : path.parent_path()),
      staging_(path_ / ".partial"),
      complete_(path_ / ".complete") {
  if (path_.empty()) throw Error(head_ + "the name of the folder is empty");
  removal_ = std::make_unique<AtTermination>([this] { tidy(patience); });
  try {
    onFirst([&] { make(); });
    mpi::broadcast(comm_, made_);
    lock_.acquire(comm_, path_, head_);
    onFirst([&] {
      const SignalsBlocked whole;
      clear();
      requireFree(naming_.mayWrite, earlier());
    });
  } catch (...) {
    tidy();
    throw;
  }
}

Folder::~Folder() {
  const SignalsBlocked whole;
  removal_.reset();
  tidy();
}

/// Throws WriteError unless this run may take the folder.
void Folder::requireOurs() const {
  const Manifest old = earlier();
  try {
    requireTakable(path_, naming_, !old.files().empty());
  } catch (const WriteError&) {
    requireFree(naming_.mayWrite, old);  // a conflicting file is a more precise message
    throw;
  }
}

void Folder::make() {
  const SignalsBlocked whole;
  requireReachable(path_, naming_.inside);
  std::vector<fs::path> missing;
  for (fs::path folder = path_; !folder.empty() && !fs::exists(folder);
       folder = folder.parent_path())
    missing.push_back(folder);
  if (missing.empty() && !naming_.inside) requireOurs();
  for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder)
    made_ += fs::create_directory(*folder);
}

/// Removes the staging folder of a killed run, and completes its commit.
void Folder::clear() {
  if (!whyNoFolder(staging_).empty()) throw WriteError(inTheWay(staging_));
  fs::remove_all(staging_);
  if (fs::exists(fs::symlink_status(complete_))) replace();
}

/// Removes files only on the last rank, when no other rank uses them any more.
void Folder::tidy(std::chrono::milliseconds patience) {
  const SignalsBlocked whole;
  const auto asLast = [&] {
    std::error_code ignored;
    if (isFolder(staging_))
      fs::remove_all(staging_, ignored);  // anything else of its name is not ours
  };
  lock_.release(asLast, patience);
  // rmdir() fails for a folder that is not empty.
  for (fs::path folder = path_; made_ > 0 && rmdir(folder.c_str()) == 0; --made_)
    folder = folder.parent_path();
}

/// Returns the files of the earlier run.
Manifest Folder::earlier() const { return Manifest::read(path_).value_or(Manifest()); }

void Folder::requireFree(const std::function<bool(const fs::path&)>& writes, const Manifest& ours,
                         const fs::path& inside) const {
  for (const auto& name : entriesOf(path_ / inside)) {
    const fs::path path = inside / name;
    if (!writes(path)) continue;
    const bool folder = isFolder(path_ / path);
    if (!(folder ? ours.folders() : ours.files()).contains(path))
      throw WriteError(inTheWay(path_ / path));
    if (folder) requireFree(writes, ours, path);
  }
}

void Folder::stage() {
  onFirst([&] {
    const SignalsBlocked whole;
    fs::create_directory(staging_);
  });
}

void Folder::commit() {
  onFirst([&] {
    Manifest fresh = Manifest::of(staging_);
    const Manifest old = earlier();
    for (const auto& folder : old.folders())
      if (isFolder(path_ / folder) && hasOtherFiles(path_, folder, old)) fresh.retain(folder);
    writeFile(staging_ / Manifest::name, fresh.text());
    for (const auto& file : fresh.files()) {
      if (const std::string why = whyNotRegular(staging_ / file); !why.empty())
        throw WriteError(why);
      sync(staging_ / file);
    }
    sync(staging_);
    const SignalsBlocked whole;
    requireFree([&](const fs::path& path) { return fresh.lists(path); }, old);
    fs::rename(staging_, complete_);
    sync(path_);
    replace();
  });
}

void Folder::discard() {
  onFirst([&] {
    const SignalsBlocked whole;
    if (const auto old = Manifest::read(path_)) removeListed(path_, *old, naming_.last);
  });
  ++made_;  // tidy() removes it like a folder that this run has created
}

/// Moves the files in .complete into place. Can resume an interrupted move: finished steps do not
/// repeat.
void Folder::replace() const {
  const fs::path manifest = complete_ / Manifest::name, last = complete_ / naming_.last;
  if (!isFolder(complete_) ||
      (!Manifest::read(complete_) && !fs::exists(last) && !fs::is_empty(complete_)))
    throw WriteError(inTheWay(complete_));
  requireRegularFiles(complete_);
  if (fs::exists(manifest)) {
    if (const auto old = Manifest::read(path_)) removeListed(path_, *old, naming_.last);
    moveAll(complete_, path_,
            [&](const fs::path& name) { return name == Manifest::name || name == naming_.last; });
    sync(path_);
    moveTo(manifest, path_ / Manifest::name);
  }
  if (fs::exists(last)) moveTo(last, path_ / naming_.last);
  fs::remove(complete_);
  sync(path_);
}

}  // namespace squeal::output
