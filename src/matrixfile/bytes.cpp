#include "matrixfile/bytes.hpp"

#include "petsc/check.hpp"

namespace squeal::matrixfile {

BinaryFile::BinaryFile(const std::filesystem::path& path) : file_(path, std::ios::binary) {
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (!file_ || error) throw Error("the file cannot be read");
}

void BinaryFile::seek(std::uint64_t position) {
  file_.seekg(static_cast<std::streamoff>(position));
}

void BinaryFile::read(void* to, std::size_t count) {
  file_.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
  if (static_cast<std::size_t>(file_.gcount()) != count) throw Error("the file is cut short");
}

}  // namespace squeal::matrixfile
