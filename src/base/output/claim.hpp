// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks that a run may write to a folder: it must be new, empty or owned by this program.
#include <filesystem>

#include "base/output/folder.hpp"

namespace squeal::output {

/// Not collective. Throws WriteError if the path or one of its parents exists but is not a folder,
/// or is a broken link. If `inside`, the folder is in a folder of this program and must not be a
/// link either.
void requireReachable(const std::filesystem::path& folder, bool inside);

/// Not collective. Throws WriteError unless a run may write into this folder, which must exist. A
/// run may do so if:
/// - it is empty, except for files that this run has opened and the remains of a killed run
///   (.partial, .complete and the lock file), or
/// - it contains results: files of a manifest (`hasFiles`) or one of the marks, which are the lock
///   file, the manifest in .complete and Naming::marks, or
/// - a case names it, and it is neither the working folder nor the home folder.
/// A run must never write into the root of the file system.
void requireTakable(const std::filesystem::path& folder, const Naming& naming, bool hasFiles);

}  // namespace squeal::output
