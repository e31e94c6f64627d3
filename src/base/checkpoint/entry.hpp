// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reads and writes the file of a checkpoint entry by MPI; each rank accesses its own part.
#include <mpi.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/checkpoint/archive.hpp"

namespace squeal::checkpoint {

/// The layout of an entry: a head, a table with the size and checksum of each rank's part, the
/// common part, and the parts in the order of the ranks.
struct Layout {
  struct Head {
    std::array<char, 8> mark = {'s', 'q', 'u', 'e', 'a', 'l', '0', '1'};
    std::uint64_t ranks = 0;
    std::uint64_t commonSize = 0, commonChecksum = 0;  // bytes, CRC-32
  };
  struct Part {
    std::uint64_t size = 0, checksum = 0;  // bytes, CRC-32
  };
  Head head;
  std::vector<Part> parts;  // [rank]

  std::size_t tableSize() const { return parts.size() * sizeof(Part); }
  MPI_Offset commonBegin() const { return sizeof head + tableSize(); }
  /// Returns the offset of the part of a rank.
  MPI_Offset partBegin(int rank) const;
  /// Returns the number of bytes of the file.
  MPI_Offset size() const { return partBegin(int(parts.size())); }
};

/// Collective. Returns the layout of an archive.
Layout layoutOf(MPI_Comm comm, const Archive& archive);

/// Collective. Writes the archive to an existing file. Returns false on all ranks if a rank fails.
bool writeEntry(MPI_Comm comm, const std::filesystem::path& path, const Layout& layout,
                const Archive& archive);

/// Collective. Returns the archive in the file; none on all ranks if the file cannot be read or is
/// damaged.
std::optional<Archive> readEntry(MPI_Comm comm, const std::filesystem::path& path);

}  // namespace squeal::checkpoint
