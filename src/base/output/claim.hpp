// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks that a run may write to a folder: it must be new, empty or owned by this program.
#include <filesystem>

#include "base/output/folder.hpp"

namespace squeal::output {

/// Not collective. Throws WriteError if the path or a parent exists and is not a folder, or is a
/// broken link. A folder `inside` one of ours must not be a link.
void requireReachable(const std::filesystem::path& folder, bool inside);

/// Not collective. Throws WriteError unless a run may write into this folder, which exists:
/// - it is empty, except for files that this run has opened and the remains of a killed run
///   (.partial, .complete and the lock file), or
/// - it contains results: files of a manifest (`hasFiles`) or one of the marks, which are the lock
///   file, the manifest in .complete and those of the naming, or
/// - a case names it, and it is neither the working folder nor the home folder.
/// It always rejects the root of the file system.
void requireTakable(const std::filesystem::path& folder, const Naming& naming, bool hasFiles);

}  // namespace squeal::output
