#include "base/checkpoint/checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

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

const FlagOption checkpointOption(
    "general", "checkpoint", true,
    "keep a checkpoint, in the folder interrupted of that of the results");
const RealOption intervalOption(
    "general", "checkpoint_interval", 60, "s", nonNegative,
    "wall time from one entry of the checkpoint to the next; 0: all that is found is written");
const FlagOption resumeOption(
    "general", "resume", false,
    "continue the run whose checkpoint is in the folder of the results; where there is none, begin "
    "anew");

constexpr const char* identityName = "identity.json";
constexpr std::array<char, 8> mark{'s', 'q', 'u', 'e', 'a', 'l', '0', '1'};

/// What a file begins with; the sizes and checksums of the ranks follow.
struct Head {
  std::array<char, 8> mark = checkpoint::mark;
  std::uint64_t ranks = 0;
  std::uint64_t commonSize = 0, commonChecksum = 0;
};
struct Part {
  std::uint64_t size = 0, checksum = 0;
};

/// Calls an MPI function that reads or writes `size` bytes from `offset` on, a piece at a time, as
/// it counts in int. Returns false if a call fails or falls short.
template <class Call>
bool inPieces(const Call& call, MPI_Offset offset, std::size_t size) {
  constexpr std::size_t most = std::size_t(1) << 30;
  for (std::size_t done = 0; done < size;) {
    const int piece = std::min(most, size - done);
    MPI_Status status;
    int moved = 0;
    if (call(offset + done, done, piece, &status) != MPI_SUCCESS ||
        MPI_Get_count(&status, MPI_BYTE, &moved) != MPI_SUCCESS || moved != piece)
      return false;
    done += piece;
  }
  return true;
}

bool onAll(MPI_Comm comm, bool here) {
  int everywhere = here;
  check(MPI_Allreduce(MPI_IN_PLACE, &everywhere, 1, MPI_INT, MPI_LAND, comm));
  return everywhere;
}

std::vector<Part> partsOf(MPI_Comm comm, const Part& own) {
  int ranks = 1;
  check(MPI_Comm_size(comm, &ranks));
  std::vector<Part> parts(ranks);
  check(MPI_Allgather(&own, sizeof own, MPI_BYTE, parts.data(), sizeof own, MPI_BYTE, comm));
  return parts;
}

/// Returns the place of the part of a rank in the file.
MPI_Offset placeOf(const Head& head, const std::vector<Part>& parts, int rank) {
  return std::accumulate(parts.begin(), parts.begin() + rank,
                         MPI_Offset(sizeof head + parts.size() * sizeof(Part) + head.commonSize),
                         [](MPI_Offset sum, const Part& part) { return sum + part.size; });
}

/// Returns the number of bytes of a stream with their checksum.
Part partOf(const Stream& stream) {
  Part part;
  for (const auto& piece : stream.pieces()) {
    part.size += piece.size();
    part.checksum = checksum(piece.data(), piece.size(), part.checksum);
  }
  return part;
}

/// Returns true for the name of a file of a checkpoint.
bool isEntry(const fs::path& path) {
  return path.filename() == identityName || path.extension() == ".entry" ||
         path.extension() == ".partial";
}

/// Throws Error if a link, or something else than folders and regular files, is where a checkpoint
/// is, or is to go: it would be read, overwritten or removed elsewhere.
void requireOurs(const fs::path& folder) {
  for (const auto& place : {folder.parent_path(), folder}) {
    const fs::file_status named = fs::symlink_status(place);
    // With a file of the user there, the run goes on without checkpoints, and a warning says so.
    if (!fs::exists(named) || fs::is_regular_file(named)) return;
    if (const std::string why = whyNoFolder(place); !why.empty())
      throw Error("the checkpoint cannot be there: " + why);
  }
  for (const auto& entry : fs::directory_iterator(folder))
    if (isEntry(entry.path()))
      if (const std::string why = whyNotRegular(entry.path()); !why.empty())
        throw Error("no file of a checkpoint: " + why);
}

}  // namespace

bool resumeWanted() { return resumeOption.get(); }

Checkpoint::Checkpoint(MPI_Comm comm, fs::path folder, Identity identity, bool resumes)
    : comm_(comm),
      folder_(std::move(folder)),
      identity_(std::move(identity)),
      enabled_(checkpointOption.get()),
      last_(MPI_Wtime()) {
  int rank = 0;
  check(MPI_Comm_rank(comm_, &rank));
  int found = 0;
  std::string different;
  std::vector<char> names;  // of the logs, once for each entry
  onFirstRank(comm_, "option -checkpoint: ", [&] { requireOurs(folder_); });
  onFirstRank(comm_, "option -resume: ", [&] {
    const auto text = contentOfRegular(folder_ / identityName);
    if (!text) return;
    try {
      different = difference(nlohmann::json::parse(*text).get<Identity>(), identity_);
    } catch (const nlohmann::json::exception&) {
      different = "its " + std::string(identityName) + " is damaged";
    }
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().extension() == ".entry") ++found;
    if (found == 0) return;
    if (!resumes) return;
    if (!different.empty())
      throw Error("the checkpoint in " + folder_.string() + " is of another run: " + different);
  });
  check(MPI_Bcast(&found, 1, MPI_INT, 0, comm_));
  if (found == 0) {
    if (resumes)
      say(comm_, "resume: there is no checkpoint in " + folder_.string() + "; the run begins anew");
    return;
  }
  exists_ = true;
  if (!resumes) {
    complain(comm_, "warning: " + folder_.string() + " holds the checkpoint of " +
                        (different.empty() ? "this case, which -resume would have continued"
                                           : "another run") +
                        "; this one replaces it with its first entry or its results");
    return;
  }
  resumed_ = begun_ = true;
  say(comm_,
      formatted("resume: %d %s in %s", found, found == 1 ? "entry" : "entries", folder_.c_str()));
}

fs::path Checkpoint::fileOf(const std::string& log, int number) const {
  return folder_ / (log + formatted("_%04d.entry", number));
}

/// Collective. Reads a file; returns false on all ranks if there is none. Throws Error if it is
/// damaged.
bool Checkpoint::read(const fs::path& path, std::vector<char>& common, std::vector<char>& own) {
  int rank = 0, ranks = 1, there = 0;
  check(MPI_Comm_rank(comm_, &rank));
  check(MPI_Comm_size(comm_, &ranks));
  onFirstRank(comm_, "", [&] {
    there = fs::exists(fs::symlink_status(path));
    if (there) close(openRegular(path, O_RDONLY, "cannot read " + path.string()));
  });
  check(MPI_Bcast(&there, 1, MPI_INT, 0, comm_));
  if (!there) return false;
  MPI_File file = MPI_FILE_NULL;
  const bool opened =
      MPI_File_open(comm_, path.c_str(), MPI_MODE_RDONLY, MPI_INFO_NULL, &file) == MPI_SUCCESS;
  bool good = onAll(comm_, opened);
  Head head;
  std::vector<Part> parts(ranks);
  const auto readTo = [&](void* data, MPI_Offset offset, std::size_t size) {
    return inPieces(
        [&](MPI_Offset at, std::size_t done, int piece, MPI_Status* status) {
          return MPI_File_read_at(file, at, static_cast<char*>(data) + done, piece, MPI_BYTE,
                                  status);
        },
        offset, size);
  };
  MPI_Offset size = 0;
  if (good) {
    MPI_File_get_size(file, &size);
    const std::size_t table = ranks * sizeof(Part);
    good = readTo(&head, 0, sizeof head) && head.mark == mark &&
           head.ranks == std::uint64_t(ranks) && readTo(parts.data(), sizeof head, table) &&
           placeOf(head, parts, ranks) == size;
    good = onAll(comm_, good);
    if (good) {
      if (rank == 0) {
        common.resize(head.commonSize);
        good = readTo(common.data(), sizeof head + table, common.size()) &&
               checksum(common.data(), common.size()) == head.commonChecksum;
      }
      own.resize(parts[rank].size);
      good = readTo(own.data(), placeOf(head, parts, rank), own.size()) && good &&
             checksum(own.data(), own.size()) == parts[rank].checksum;
    }
  }
  if (opened) MPI_File_close(&file);
  if (!onAll(comm_, good))
    throw Error("the checkpoint is damaged: " + path.string() +
                "; without -resume the run begins anew");
  common.resize(head.commonSize);
  constexpr std::size_t most = std::size_t(1) << 30;
  for (std::size_t done = 0; done < common.size(); done += most)
    check(
        MPI_Bcast(common.data() + done, std::min(most, common.size() - done), MPI_BYTE, 0, comm_));
  return true;
}

std::optional<Archive> Checkpoint::next(const std::string& log) {
  if (!resumed_) return {};
  std::vector<char> common, own;
  if (!read(fileOf(log, read_[log]), common, own)) return {};
  count_[log] = ++read_[log];
  return Archive(comm_, std::move(common), std::move(own));
}

bool Checkpoint::due() {
  if (!enabled_) return false;
  constexpr double most = 0.05;  // of the time is spent on entries
  const double interval = intervalOption.get(), since = MPI_Wtime() - last_;
  int is = stopAsked() || interval == 0 || since >= std::max(interval, cost_ / most);
  check(MPI_Allreduce(MPI_IN_PLACE, &is, 1, MPI_INT, MPI_LOR, comm_));
  return is;
}

bool Checkpoint::isWorth(double seconds) const {
  if (!enabled_) return false;
  int is = seconds >= intervalOption.get() / 6;
  check(MPI_Bcast(&is, 1, MPI_INT, 0, comm_));
  return is;
}

/// Removes the checkpoint of an earlier run and begins that of this one. On rank 0 alone.
void Checkpoint::beginAnew() {
  const SignalsBlocked whole;
  requireOurs(folder_);
  fs::create_directories(folder_);
  clear();
  output::writeFile(folder_ / identityName, nlohmann::json(identity_).dump(1) + "\n");
}

void Checkpoint::write(const std::string& log, const Archive& archive) {
  if (!enabled_) return;
  int rank = 0, ranks = 1;
  check(MPI_Comm_rank(comm_, &rank));
  check(MPI_Comm_size(comm_, &ranks));
  const double begin = MPI_Wtime();
  const auto parts = partsOf(comm_, partOf(archive.own));
  const Part common = partOf(archive.common);
  Head head;
  head.ranks = ranks;
  head.commonSize = common.size;
  head.commonChecksum = common.checksum;
  check(MPI_Bcast(&head, sizeof head, MPI_BYTE, 0, comm_));
  const fs::path path = fileOf(log, count_[log]), partial = fs::path(path) += ".partial";
  try {
    onFirstRank(comm_, "", [&] {
      if (!begun_) beginAnew();
      output::reserve(partial, placeOf(head, parts, ranks));
    });
    MPI_File file = MPI_FILE_NULL;
    const bool opened =
        MPI_File_open(comm_, partial.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file) == MPI_SUCCESS;
    bool good = onAll(comm_, opened);
    if (good) {
      const auto writeFrom = [&](const void* data, MPI_Offset offset, std::size_t size) {
        return inPieces(
            [&](MPI_Offset at, std::size_t done, int piece, MPI_Status* status) {
              return MPI_File_write_at(file, at, static_cast<const char*>(data) + done, piece,
                                       MPI_BYTE, status);
            },
            offset, size);
      };
      const auto writeAll = [&](const Stream& stream, MPI_Offset offset) {
        for (const auto& piece : stream.pieces()) {
          if (!writeFrom(piece.data(), offset, piece.size())) return false;
          offset += piece.size();
        }
        return true;
      };
      const std::size_t table = parts.size() * sizeof(Part);
      if (rank == 0)
        good = writeFrom(&head, 0, sizeof head) && writeFrom(parts.data(), sizeof head, table) &&
               writeAll(archive.common, sizeof head + table);
      good = writeAll(archive.own, placeOf(head, parts, rank)) && good;
    }
    if (opened) good = MPI_File_close(&file) == MPI_SUCCESS && good;
    if (!onAll(comm_, good)) throw Error(output::cannotWrite(partial, ENOSPC));
    onFirstRank(comm_, "", [&] {
      const SignalsBlocked whole;
      output::sync(partial);
      fs::rename(partial, path);
      output::sync(folder_);
    });
  } catch (const Error& error) {
    complain(comm_, std::string("warning: no more checkpoints: ") + error.what());
    std::error_code ignored;
    if (rank == 0 && whyNotRegular(partial).empty()) fs::remove(partial, ignored);
    enabled_ = false;
    return;
  }
  begun_ = exists_ = true;
  ++count_[log];
  last_ = MPI_Wtime();
  cost_ = last_ - begin;
  tellEvent("checkpoint",
            {{"file", path.string()}, {"bytes", placeOf(head, parts, ranks)}, {"seconds", cost_}});
}

/// Removes what is of a checkpoint. On rank 0 alone.
void Checkpoint::clear() const {
  // Its identity goes first: entries without one are of no use to anybody.
  fs::remove(folder_ / identityName);
  for (const auto& entry : std::vector<fs::directory_entry>(fs::directory_iterator(folder_), {}))
    if (isEntry(entry.path())) fs::remove(entry.path());
}

void Checkpoint::remove() {
  int rank = 0;
  if (comm_ == MPI_COMM_NULL) return;
  check(MPI_Comm_rank(comm_, &rank));
  exists_ = false;
  if (rank > 0) return;
  const SignalsBlocked whole;
  try {
    requireOurs(folder_);
    if (!fs::exists(folder_)) return;
    clear();                  // what a run has left that was killed in its first entry, too
    std::error_code ignored;  // what is not ours stays
    fs::remove(folder_, ignored);
    fs::remove(folder_.parent_path(), ignored);
  } catch (const std::exception& error) {
    complain(comm_, std::string("warning: a checkpoint is left behind: ") + error.what());
  }
}

}  // namespace squeal::checkpoint
