// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks that a run may write to a folder: it must be new, empty or owned by this program.
#include <filesystem>

#include "base/output/folder.hpp"

namespace squeal::output {

/// Not collective. Throws WriteError if the path or one of its parents exists but is not a folder,
/// or is a broken link. With `inside`, for a folder in a folder of this program, also throws it if
/// the folder is a link.
void requireReachable(const std::filesystem::path& folder, bool inside);

/// Not collective. Throws WriteError unless a run may write into this folder, which must exist. A
/// run may do so if:
/// - it is empty, except for files that this run has opened and the remains of a killed run
///   (.partial, .complete and the lock file), or
/// - it contains results of this program: files listed in a manifest (`hasFiles`), the lock file, a
///   manifest in .complete or one of Naming::marks, or
/// - a case names it (Naming::ofCase), and it is neither the working folder nor the home folder.
/// A run must never write into the root of the file system.
void requireTakable(const std::filesystem::path& folder, const Naming& naming, bool hasFiles);

}  // namespace squeal::output
