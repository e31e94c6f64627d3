// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Writes files on one rank. Once termination from outside has started, no write starts
/// (SignalsBlocked), so no file appears after the removal.
#include <fcntl.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace squeal::output {

/// A failure of only this rank, such as "cannot write PATH: reason". The caller must share it by
/// onFirstRank() or failTogether().
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns "cannot write PATH: reason" with the reason of an errno value, or no reason for 0.
std::string cannotWrite(const std::filesystem::path& path, int error);

/// Not collective. Opens an empty file to write to and returns its descriptor. Truncates an
/// existing file. Throws WriteError, also if the path is a link, has a second name or is not a
/// regular file, since its content may belong to another user.
int openToWrite(const std::filesystem::path& path, int flags = O_WRONLY);

/// Not collective. Writes the whole file, as openToWrite() opens it. Throws WriteError.
void writeFile(const std::filesystem::path& path, const std::string& text);

/// Not collective. Creates an empty file and reserves `bytes` on the disk, for a library that
/// follows links and handles a full disk badly. A file system that cannot reserve space is not an
/// error. Throws WriteError.
void reserve(const std::filesystem::path& path, unsigned long long bytes);

/// Not collective. Waits until the content of a file, or the entries of a folder, are on the disk.
/// Throws WriteError.
void sync(const std::filesystem::path& path);

}  // namespace squeal::output
