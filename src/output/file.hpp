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

/// "cannot write PATH: reason" with the reason of an errno value; 0: none is known.
std::string cannotWrite(const std::filesystem::path& path, int error);

/// Not collective. Writes the whole file, replacing what is there. Error: WriteError.
void writeFile(const std::filesystem::path& path, const std::string& text);

/// Not collective. Makes an empty file with room for `bytes` on the disc: for a library that does
/// not end well where room is missing. Error: WriteError.
void reserve(const std::filesystem::path& path, unsigned long long bytes);

/// Not collective. Returns when the content of a file, or the entries of a folder, are on the disc.
/// Error: WriteError.
void sync(const std::filesystem::path& path);

}  // namespace squeal::output
