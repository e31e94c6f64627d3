#include "base/output/claim.hpp"

#include <algorithm>
#include <cstdlib>

#include "base/output/file.hpp"
#include "base/output/lock.hpp"
#include "base/system/regular_file.hpp"

namespace squeal::output {

namespace fs = std::filesystem;

namespace {

/// Returns true if both are there and are one file or folder.
bool isSame(const fs::path& one, const fs::path& other) {
  std::error_code none;
  return fs::equivalent(one, other, none) && !none;
}

bool isRegular(const fs::path& path) { return fs::is_regular_file(fs::symlink_status(path)); }

/// Returns true if nothing is in the folder but what this run has opened and what a killed run
/// leaves.
bool isEmpty(const fs::path& folder, const Naming& naming) {
  const auto isOurs = [&](const fs::path& path) {
    const fs::path name = path.filename();
    return name == Lock::name || name == ".partial" || name == ".complete" ||
           std::ranges::any_of(naming.opened,
                               [&](const fs::path& opened) { return isSame(path, opened); });
  };
  return std::ranges::all_of(fs::directory_iterator(folder),
                             [&](const auto& entry) { return isOurs(entry.path()); });
}

bool isMarked(const fs::path& folder, const Naming& naming) {
  std::vector<fs::path> marks = naming.marks;
  marks.emplace_back(Lock::name);
  marks.push_back(fs::path(".complete") / Manifest::name);
  return std::ranges::any_of(marks, [&](const fs::path& mark) { return isRegular(folder / mark); });
}

/// A case may not strew results over the folder in which somebody works or lives.
bool isOfSomebody(const fs::path& folder) {
  const char* home = std::getenv("HOME");
  return isSame(folder, fs::current_path()) || (home && *home && isSame(folder, home));
}

}  // namespace

void requireReachable(const fs::path& folder, bool inside) {
  if (inside)
    if (const std::string why = whyNoFolder(folder); !why.empty()) throw WriteError(why);
  for (fs::path part = folder; !part.empty(); part = part.parent_path()) {
    const fs::file_status named = fs::symlink_status(part), target = fs::status(part);
    if (fs::is_symlink(named) && !fs::exists(target))
      throw WriteError(part.string() + " is a link to " + fs::read_symlink(part).string() +
                       ", which does not exist");
    if (fs::is_directory(target)) return;
    if (fs::exists(target))
      throw WriteError(fs::is_symlink(named)
                           ? part.string() + " is a link to something else than a folder"
                           : whyNoFolder(part));
    if (part == part.parent_path()) return;
  }
}

void requireTakable(const fs::path& folder, const Naming& naming, bool hasFiles) {
  if (isSame(folder, "/"))
    throw WriteError(folder.string() + " is the root of the file system: name another folder");
  if (isEmpty(folder, naming) || hasFiles || isMarked(folder, naming)) return;
  if (naming.ofCase && !isOfSomebody(folder)) return;
  throw WriteError(folder.string() +
                   " is not empty and holds no earlier results: a run writes into a new or empty "
                   "folder, into one "
                   "with results of this program (" +
                   Manifest::name +
                   " lists them) or what such a run has left, or into one that the case names; "
                   "name another folder");
}

}  // namespace squeal::output
