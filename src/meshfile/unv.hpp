#pragma once
/// Checks of I-deas universal files before gmsh reads them.
#include <cstdint>
#include <string>

namespace squeal::meshfile {

struct UnvContents {
  std::int64_t nodes = 0, elements = 0;
};

/// Returns the contents of a .unv file. Throws Error, with the line, unless the sections of nodes
/// (2411) and elements (2412) hold tags that are positive and given once, finite coordinates, and
/// elements on existing nodes. Throws Error also if the names of two groups (2435, 2452, 2477)
/// begin with the same word, which is all that gmsh reads of a name. gmsh's reader silently leaves
/// a section at a line that it does not understand. Not collective.
UnvContents requireSoundUnv(const std::string& file);

}  // namespace squeal::meshfile
