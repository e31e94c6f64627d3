// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Numbers in binary files of either byte order.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace squeal::matrixfile {

constexpr bool littleEndian = std::endian::native == std::endian::little;

/// Returns the number at `bytes`. If `swapped`, its bytes are in the order opposite to this
/// machine's.
template <class Number>
Number numberAt(const char* bytes, bool swapped) {
  char copy[sizeof(Number)];
  std::memcpy(copy, bytes, sizeof copy);
  if (swapped) std::reverse(copy, copy + sizeof copy);
  Number number;
  std::memcpy(&number, copy, sizeof copy);
  return number;
}

/// A binary file that is read piece by piece.
class BinaryFile {
 public:
  /// Throws Error if the file cannot be opened.
  explicit BinaryFile(const std::filesystem::path& path);
  std::uint64_t size() const { return size_; }
  void seek(std::uint64_t position);
  /// Reads `count` bytes. Throws Error if the file is too short.
  void read(char* to, std::size_t count);
  template <class Number>
  Number number(bool swapped) {
    char bytes[sizeof(Number)];
    read(bytes, sizeof bytes);
    return numberAt<Number>(bytes, swapped);
  }

 private:
  std::ifstream file_;
  std::uint64_t size_ = 0;
};

}  // namespace squeal::matrixfile
