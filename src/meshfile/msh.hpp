#pragma once
/// gmsh's mesh format, checked before gmsh reads it.
#include <cstdint>
#include <string>

namespace squeal::meshfile {

struct MshContents {
  double version = 0;
  std::int64_t nodes = 0, elements = 0;
};

/// gmsh's reader of .msh files believes their headers: it writes beyond its arrays, stops early
/// without a word, and takes -1 for a node. Error, with the line (or byte, in a binary file),
/// unless the sections $Nodes and $Elements hold what their headers promise: tags that are positive
/// and given once, finite coordinates, elements of known types on nodes that there are. Versions 2
/// to 4.1, ASCII and binary. Not collective.
MshContents requireSoundMsh(const std::string& file);

}  // namespace squeal::meshfile
