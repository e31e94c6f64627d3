// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Opens the program's own files safely in folders where other users may have created something
/// under the same name: a link could lead to another user's file, and a pipe would block.
#include <filesystem>
#include <optional>
#include <string>

namespace squeal {

/// Not collective. Returns a sentence such as "PATH is a link, not a regular file" if the path
/// exists and is not a regular file; otherwise an empty text.
std::string whyNotRegular(const std::filesystem::path& path);

/// Not collective. Returns a sentence such as "PATH is a link, not a folder" if the path exists and
/// is not a folder; otherwise an empty text.
std::string whyNoFolder(const std::filesystem::path& path);

/// Not collective. Opens a file as open(2) does with these flags and returns its descriptor. It
/// follows no link, opens only a regular file, and does not wait for the other end of a pipe. With
/// O_TRUNC it also rejects a file with a second name (a hard link), which may belong to another
/// user. Throws Error if it does not open the file. The message is `failure` with the reason
/// ("cannot write PATH: reason"), or a sentence such as that of whyNotRegular().
int openRegular(const std::filesystem::path& path, int flags, const std::string& failure);

/// Not collective. Returns the content of a regular file; none if the path does not exist. Throws
/// Error as openRegular does, or if the file cannot be read.
std::optional<std::string> contentOfRegular(const std::filesystem::path& path);

}  // namespace squeal
