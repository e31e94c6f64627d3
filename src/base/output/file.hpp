#pragma once
/// These functions write files on one rank. Once the run is being ended from outside, none is begun
/// (SignalsBlocked), since the clearing up must not be undone.
#include <fcntl.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace squeal::output {

/// A WriteError reports a failure of this rank alone, such as "cannot write PATH: reason". It has
/// to be shared by onFirstRank or failTogether.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns "cannot write PATH: reason" with the reason of an errno value; without a reason for 0.
std::string cannotWrite(const std::filesystem::path& path, int error);

/// Not collective. Opens an empty file to write to. An existing one is emptied, unless it is a
/// link, has a second name, or is no regular file: what it leads to is not ours. Returns its
/// descriptor. Throws WriteError.
int openToWrite(const std::filesystem::path& path, int flags = O_WRONLY);

/// Not collective. Writes the whole file; an existing one is replaced as openToWrite does. Throws
/// WriteError.
void writeFile(const std::filesystem::path& path, const std::string& text);

/// Not collective. Makes an empty file with room for `bytes` on the disc, for a library that fails
/// badly on a full disc, and follows links. A file system that cannot reserve room is no error.
/// Throws WriteError.
void reserve(const std::filesystem::path& path, unsigned long long bytes);

/// Not collective. Returns when the content of a file, or the entries of a folder, are on the disc.
/// Throws WriteError.
void sync(const std::filesystem::path& path);

}  // namespace squeal::output
