// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrixfile/bytes.hpp"

#include "base/petsc/check.hpp"

namespace squeal::matrixfile {

BinaryFile::BinaryFile(const std::filesystem::path& path) : file_(path, std::ios::binary) {
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (!file_ || error) throw Error("the file cannot be read");
}

void BinaryFile::seek(std::uint64_t position) { file_.seekg(position); }

void BinaryFile::read(char* to, std::size_t count) {
  if (!file_.read(to, count)) throw Error("the file is truncated");
}

}  // namespace squeal::matrixfile
