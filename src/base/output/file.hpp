// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Writes files on one rank. Once termination from outside has begun, no new write begins (see
/// SignalsBlocked), so no file appears after the termination handlers have removed the files.
#include <fcntl.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace squeal::output {

/// A failure on only this rank, such as "cannot write PATH: reason". The caller must share it with
/// the other ranks by onFirstRank() or failTogether().
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns "cannot write PATH: reason" with the reason of an errno value; without a reason for 0.
std::string cannotWrite(const std::filesystem::path& path, int error);

/// Not collective. Creates a file, or empties an existing one, and returns the descriptor for
/// writing. Throws WriteError if this fails. Also throws it if the path is a link, has a second
/// name (a hard link) or is not a regular file, since the content may then belong to another user.
int openToWrite(const std::filesystem::path& path, int flags = O_WRONLY);

/// Not collective. Opens a file by openToWrite() and writes the text as its whole content. Throws
/// WriteError.
void writeFile(const std::filesystem::path& path, const std::string& text);

/// Not collective. Creates an empty file and reserves `bytes` on the disk. Use it before a library
/// that follows links and handles a full disk badly writes the file. It is not an error if the file
/// system cannot reserve space. Throws WriteError.
void reserve(const std::filesystem::path& path, unsigned long long bytes);

/// Not collective. Waits until the content of a file, or the entries of a folder, are on the disk.
/// Throws WriteError.
void sync(const std::filesystem::path& path);

}  // namespace squeal::output
