// SPDX-License-Identifier: BSD-2-Clause
#include "base/output/claim.hpp"

#include <algorithm>
#include <cstdlib>

#include "base/output/file.hpp"
#include "base/output/lock.hpp"
#include "base/system/regular_file.hpp"

namespace squeal::output {

namespace fs = std::filesystem;

namespace {

/// Returns true if both exist and are the same file or folder.
bool isSame(const fs::path& one, const fs::path& other) {
  std::error_code none;
  return fs::equivalent(one, other, none) && !none;
}

bool isRegular(const fs::path& path) { return fs::is_regular_file(fs::symlink_status(path)); }

/// Returns true if the folder contains nothing except files that this run has opened and the
/// remains of a killed run.
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

/// Returns true for the working folder and the home folder, which a case must not fill with
/// results.
bool isPersonal(const fs::path& folder) {
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
      throw WriteError(fs::is_symlink(named) ? part.string() + " is a link, but not to a folder"
                                             : whyNoFolder(part));
    if (part == part.parent_path()) return;
  }
}

void requireTakable(const fs::path& folder, const Naming& naming, bool hasFiles) {
  if (isSame(folder, "/"))
    throw WriteError(folder.string() + " is the root of the file system: name another folder");
  if (isEmpty(folder, naming) || hasFiles || isMarked(folder, naming)) return;
  if (naming.ofCase && !isPersonal(folder)) return;
  throw WriteError(folder.string() +
                   " is not empty and contains no earlier results: a run writes only to a new or "
                   "empty folder, to one with results of this program (listed in " +
                   Manifest::name +
                   ") or their remains, or to one that the case names; name another folder");
}

}  // namespace squeal::output
