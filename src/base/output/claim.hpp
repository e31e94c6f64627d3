#pragma once
/// A run writes into a folder that is new, empty, or one of its own: these functions tell which.
#include <filesystem>

#include "base/output/folder.hpp"

namespace squeal::output {

/// Not collective. Throws WriteError if the path, or what it is to be made in, is something else
/// than a folder, or a link that leads nowhere. A folder `inside` one of ours may be no link.
void requireReachable(const std::filesystem::path& folder, bool inside);

/// Not collective. Throws WriteError unless a run may write into this folder, which exists:
/// - it is empty, but for what this run has opened and what a killed run leaves (.partial,
/// .complete
///   and the file of the lock), or
/// - it holds results: `hasFiles`, those of a manifest or of a version without one, or one of the
///   marks: the file of the lock, the manifest in .complete, and those of the naming, or
/// - a case names it, and it is neither the working folder nor the home folder.
/// The root of the file system is refused always.
void requireTakable(const std::filesystem::path& folder, const Naming& naming, bool hasFiles);

}  // namespace squeal::output
