// SPDX-License-Identifier: BSD-2-Clause
#include "base/checkpoint/entry.hpp"

#include <algorithm>
#include <numeric>

#include "base/checkpoint/identity.hpp"
#include "base/system/concatenation.hpp"

namespace squeal::checkpoint {
namespace {

/// Calls an MPI function that reads or writes `size` bytes from `offset` on, a piece at a time,
/// since its count is an int. Returns false if a call fails or moves fewer bytes.
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

/// A file that all ranks open and close together.
class File {
 public:
  /// Collective.
  File(MPI_Comm comm, const std::filesystem::path& path, int mode)
      : isOpen_(MPI_File_open(comm, path.c_str(), mode, MPI_INFO_NULL, &file_) == MPI_SUCCESS) {}
  /// Collective.
  ~File() { close(); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  bool isOpen() const { return isOpen_; }
  /// Collective. Returns false if the file was not open or cannot be closed.
  bool close() {
    const bool wasOpen = isOpen_;
    isOpen_ = false;
    return wasOpen && MPI_File_close(&file_) == MPI_SUCCESS;
  }
  MPI_Offset size() const {
    MPI_Offset bytes = 0;
    MPI_File_get_size(file_, &bytes);
    return bytes;
  }
  bool read(void* data, MPI_Offset offset, std::size_t size) const {
    return inPieces(
        [&](MPI_Offset at, std::size_t done, int piece, MPI_Status* status) {
          return MPI_File_read_at(file_, at, static_cast<char*>(data) + done, piece, MPI_BYTE,
                                  status);
        },
        offset, size);
  }
  bool write(const void* data, MPI_Offset offset, std::size_t size) const {
    return inPieces(
        [&](MPI_Offset at, std::size_t done, int piece, MPI_Status* status) {
          return MPI_File_write_at(file_, at, static_cast<const char*>(data) + done, piece,
                                   MPI_BYTE, status);
        },
        offset, size);
  }
  bool write(const Stream& stream, MPI_Offset offset) const {
    for (const auto& piece : stream.pieces()) {
      if (!write(piece.data(), offset, piece.size())) return false;
      offset += piece.size();
    }
    return true;
  }

 private:
  MPI_File file_ = MPI_FILE_NULL;
  bool isOpen_;
};

/// Returns the number of bytes of a stream with their checksum.
Layout::Part partOf(const Stream& stream) {
  Layout::Part part;
  for (const auto& piece : stream.pieces()) {
    part.size += piece.size();
    part.checksum = checksum(piece.data(), piece.size(), part.checksum);
  }
  return part;
}

/// Returns the layout of a file; none if the file is not an entry for this number of ranks.
std::optional<Layout> readLayout(const File& file, int ranks) {
  Layout layout;
  layout.parts.resize(ranks);
  if (!file.read(&layout.head, 0, sizeof layout.head)) return {};
  if (layout.head.mark != Layout::Head().mark) return {};
  if (layout.head.ranks != std::uint64_t(ranks)) return {};
  if (!file.read(layout.parts.data(), sizeof layout.head, layout.tableSize())) return {};
  if (layout.size() != file.size()) return {};
  return layout;
}

/// Returns bytes of the file; none if they cannot be read or are damaged.
std::optional<std::vector<char>> readBytes(const File& file, MPI_Offset begin, std::size_t size,
                                           std::uint64_t sum) {
  std::vector<char> bytes(size);
  if (!file.read(bytes.data(), begin, size)) return {};
  if (checksum(bytes.data(), size) != sum) return {};
  return bytes;
}

}  // namespace

MPI_Offset Layout::partBegin(int rank) const {
  return std::accumulate(parts.begin(), parts.begin() + rank,
                         commonBegin() + MPI_Offset(head.commonSize),
                         [](MPI_Offset sum, const Part& part) { return sum + part.size; });
}

Layout layoutOf(MPI_Comm comm, const Archive& archive) {
  Layout layout;
  layout.parts = concatenated(comm, std::vector{partOf(archive.own)});
  const auto common = partOf(archive.common);
  layout.head.ranks = layout.parts.size();
  layout.head.commonSize = common.size;
  layout.head.commonChecksum = common.checksum;
  mpi::broadcast(comm, layout.head);
  return layout;
}

bool writeEntry(MPI_Comm comm, const std::filesystem::path& path, const Layout& layout,
                const Archive& archive) {
  File file(comm, path, MPI_MODE_WRONLY);
  if (!mpi::all(comm, file.isOpen())) return false;
  const int rank = mpi::rank(comm);
  bool written = file.write(archive.own, layout.partBegin(rank));
  if (rank == 0)
    written = written && file.write(&layout.head, 0, sizeof layout.head) &&
              file.write(layout.parts.data(), sizeof layout.head, layout.tableSize()) &&
              file.write(archive.common, layout.commonBegin());
  const bool closed = file.close();
  return mpi::all(comm, written && closed);
}

std::optional<Archive> readEntry(MPI_Comm comm, const std::filesystem::path& path) {
  const File file(comm, path, MPI_MODE_RDONLY);
  if (!mpi::all(comm, file.isOpen())) return {};
  const auto layout = readLayout(file, mpi::size(comm));
  if (!mpi::all(comm, layout.has_value())) return {};
  const auto& [head, parts] = *layout;
  const int rank = mpi::rank(comm);
  auto own = readBytes(file, layout->partBegin(rank), parts[rank].size, parts[rank].checksum);
  std::optional<std::vector<char>> common(std::in_place);
  if (rank == 0)
    common = readBytes(file, layout->commonBegin(), head.commonSize, head.commonChecksum);
  if (!mpi::all(comm, own && common)) return {};
  common->resize(head.commonSize);
  mpi::broadcastBytes(comm, common->data(), common->size(), 0);
  return Archive(comm, std::move(*common), std::move(*own));
}

}  // namespace squeal::checkpoint
