#pragma once
/// These functions open files of the program's own, in folders where anybody may have put something
/// else under their names: a link would lead to a foreign file, a pipe would block.
#include <filesystem>
#include <optional>
#include <string>

namespace squeal {

/// Not collective. Returns a sentence such as "PATH is a link, not a regular file" if something
/// else than a regular file has this name; empty if a regular file or nothing has it.
std::string whyNotRegular(const std::filesystem::path& path);

/// Not collective. Returns a sentence such as "PATH is a link, not a folder" if something else than
/// a folder has this name; empty if a folder or nothing has it.
std::string whyNoFolder(const std::filesystem::path& path);

/// Not collective. Opens a file as open(2) does with these flags. It follows no link, opens only a
/// regular file, and does not wait for the other end of a pipe. With O_TRUNC, a file that has a
/// second name (a hard link) is refused as well, since it may be a foreign one. Returns the
/// descriptor. Throws Error, whose message begins with `failure`, as "cannot write PATH: reason",
/// or says what the path is.
int openRegular(const std::filesystem::path& path, int flags, const std::string& failure);

/// Not collective. Returns the content of a regular file; none if nothing has this name. Throws
/// Error as openRegular does, or if it cannot be read.
std::optional<std::string> contentOfRegular(const std::filesystem::path& path);

}  // namespace squeal
