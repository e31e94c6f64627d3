// SPDX-License-Identifier: BSD-2-Clause
#include "base/checkpoint/checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/checkpoint/entry.hpp"
#include "base/options/options.hpp"
#include "base/output/file.hpp"
#include "base/session/events.hpp"
#include "base/session/stages.hpp"
#include "base/system/regular_file.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"

namespace squeal::checkpoint {

namespace fs = std::filesystem;

namespace {

constexpr const char* identityName = "identity.json";

/// Returns true for the name of a file of a checkpoint. A run that is killed while it opens an
/// entry leaves a file by which Open MPI tests locks, such as log_0001.entry.partial.locktest.0.
bool isEntry(const fs::path& path) {
  return path.filename() == identityName || path.extension() == ".entry" ||
         path.extension() == ".partial" ||
         path.filename().string().find(".entry.partial.") != std::string::npos;
}

/// Throws Error if a link, or anything except folders and regular files, is in the place of the
/// checkpoint: the run would read, overwrite or remove something elsewhere.
void requireOurs(const fs::path& folder) {
  for (const auto& place : {folder.parent_path(), folder}) {
    const fs::file_status named = fs::symlink_status(place);
    // If the user has a file there, the run continues without checkpoints, after a warning.
    if (!fs::exists(named) || fs::is_regular_file(named)) return;
    if (const std::string why = whyNoFolder(place); !why.empty())
      throw Error("the checkpoint cannot be stored there: " + why);
  }
  for (const auto& entry : fs::directory_iterator(folder))
    if (isEntry(entry.path()))
      if (const std::string why = whyNotRegular(entry.path()); !why.empty())
        throw Error("invalid file in the checkpoint folder: " + why);
}

/// Returns the difference between the identity in the folder and `ours`; none if the folder has no
/// identity. On rank 0.
std::optional<std::string> differenceFrom(const Identity& ours, const fs::path& folder) {
  const auto text = contentOfRegular(folder / identityName);
  if (!text) return {};
  try {
    return difference(nlohmann::json::parse(*text).get<Identity>(), ours);
  } catch (const nlohmann::json::exception&) {
    return "its " + std::string(identityName) + " is damaged";
  }
}

/// Returns the number of entries in the folder. On rank 0.
int entriesIn(const fs::path& folder) {
  return int(std::ranges::count_if(fs::directory_iterator(folder), [](const auto& entry) {
    return entry.path().extension() == ".entry";
  }));
}

}  // namespace

Checkpoint::Checkpoint(MPI_Comm comm, fs::path folder, Identity identity, const Settings& settings)
    : comm_(comm),
      folder_(std::move(folder)),
      identity_(std::move(identity)),
      settings_(settings),
      last_(MPI_Wtime()) {
  int found = 0;
  std::string different;
  onFirstRank(comm_, "option -checkpoint: ", [&] { requireOurs(folder_); });
  onFirstRank(comm_, "option -resume: ", [&] {
    const auto differs = differenceFrom(identity_, folder_);
    if (!differs) return;
    different = *differs;
    found = entriesIn(folder_);
    if (found > 0 && settings.resume && !different.empty())
      throw Error("the checkpoint in " + folder_.string() +
                  " belongs to another run: " + different);
  });
  mpi::broadcast(comm_, found);
  if (found == 0) {
    if (settings.resume)
      printLine(comm_, "resume: there is no checkpoint in " + folder_.string() +
                           "; the run starts from scratch");
    return;
  }
  exists_ = true;
  if (!settings.resume) {
    printWarning(comm_, "warning: " + folder_.string() + " contains the checkpoint of " +
                            (different.empty() ? "this case, which -resume would have used"
                                               : "another run") +
                            "; this run replaces it with its first entry or its results");
    return;
  }
  resumed_ = begun_ = true;
  printLine(comm_, formatted("resume: %d %s in %s", found, found == 1 ? "entry" : "entries",
                             folder_.c_str()));
}

fs::path Checkpoint::fileOf(const std::string& log, int number) const {
  return folder_ / (log + formatted("_%04d.entry", number));
}

std::optional<Archive> Checkpoint::next(const std::string& log) {
  if (!resumed_) return {};
  const fs::path path = fileOf(log, read_[log]);
  bool exists = false;
  onFirstRank(comm_, "", [&] {
    exists = fs::exists(fs::symlink_status(path));
    if (exists) close(openRegular(path, O_RDONLY, "cannot read " + path.string()));
  });
  mpi::broadcast(comm_, exists);
  if (!exists) return {};
  auto archive = readEntry(comm_, path);
  if (!archive)
    throw Error("the checkpoint is damaged: " + path.string() +
                "; without -resume the run starts from scratch");
  count_[log] = ++read_[log];
  return archive;
}

bool Checkpoint::due() {
  if (!settings_.enabled) return false;
  constexpr double most = 0.05;  // share of the time that entries may take
  const double interval = settings_.interval, since = MPI_Wtime() - last_;
  return mpi::any(comm_,
                  stopRequested() || interval == 0 || since >= std::max(interval, cost_ / most));
}

bool Checkpoint::isWorth(double seconds) const {
  if (!settings_.enabled) return false;
  bool is = seconds >= settings_.interval / 6;
  mpi::broadcast(comm_, is);
  return is;
}

/// Removes the checkpoint of an earlier run and writes the identity of this one. On rank 0.
void Checkpoint::prepareFolder() const {
  const SignalsBlocked whole;
  requireOurs(folder_);
  fs::create_directories(folder_);
  clear();
  output::writeFile(folder_ / identityName, nlohmann::json(identity_).dump(1) + "\n");
}

void Checkpoint::write(const std::string& log, const Archive& archive) {
  if (!settings_.enabled) return;
  const double begin = MPI_Wtime();
  const Layout layout = layoutOf(comm_, archive);
  const fs::path path = fileOf(log, count_[log]), partial = fs::path(path) += ".partial";
  try {
    onFirstRank(comm_, "", [&] {
      if (!begun_) prepareFolder();
      output::reserve(partial, layout.size());
    });
    if (!writeEntry(comm_, partial, layout, archive))
      throw Error(output::cannotWrite(partial, ENOSPC));
    onFirstRank(comm_, "", [&] {
      const SignalsBlocked whole;
      output::sync(partial);
      fs::rename(partial, path);
      output::sync(folder_);
    });
  } catch (const Error& error) {
    printWarning(comm_,
                 std::string("warning: the run writes no more checkpoints: ") + error.what());
    std::error_code ignored;
    if (mpi::rank(comm_) == 0 && whyNotRegular(partial).empty()) fs::remove(partial, ignored);
    settings_.enabled = false;
    return;
  }
  begun_ = exists_ = true;
  ++count_[log];
  last_ = MPI_Wtime();
  cost_ = last_ - begin;
  logEvent("checkpoint", {{"file", path.string()}, {"bytes", layout.size()}, {"seconds", cost_}});
}

/// Removes the files of a checkpoint. On rank 0.
void Checkpoint::clear() const {
  // The identity goes first: entries without one are useless.
  fs::remove(folder_ / identityName);
  for (const auto& entry : std::vector<fs::directory_entry>(fs::directory_iterator(folder_), {}))
    if (isEntry(entry.path())) fs::remove(entry.path());
}

void Checkpoint::remove() {
  if (comm_ == MPI_COMM_NULL) return;
  exists_ = false;
  if (mpi::rank(comm_) > 0) return;
  const SignalsBlocked whole;
  try {
    requireOurs(folder_);
    if (!fs::exists(folder_)) return;
    clear();                  // also the remains of a run that was killed during its first entry
    std::error_code ignored;  // folders with files of the user stay
    fs::remove(folder_, ignored);
    fs::remove(folder_.parent_path(), ignored);
  } catch (const std::exception& error) {
    printWarning(comm_, std::string("warning: cannot remove the checkpoint: ") + error.what());
  }
}

}  // namespace squeal::checkpoint
