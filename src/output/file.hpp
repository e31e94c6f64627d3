#pragma once
/// Files written by one rank. Where the run is being ended from outside, none is begun
/// (EndingWaits): what clears up must not be undone.
#include <filesystem>
#include <stdexcept>
#include <string>

namespace squeal::output {

/// A failure of this rank alone, to be shared by onFirstRank or failTogether: "cannot write PATH:
/// reason".
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns "cannot write PATH: reason" with the reason of an errno value; 0: none is known.
std::string cannotWrite(const std::filesystem::path& path, int error);

/// Not collective. Writes the whole file; an existing one is replaced. Throws WriteError.
void writeFile(const std::filesystem::path& path, const std::string& text);

/// Not collective. Makes an empty file with room for `bytes` on the disc, for a library that fails
/// badly on a full disc. Throws WriteError.
void reserve(const std::filesystem::path& path, unsigned long long bytes);

/// Not collective. Returns when the content of a file, or the entries of a folder, are on the disc.
/// Throws WriteError.
void sync(const std::filesystem::path& path);

}  // namespace squeal::output
