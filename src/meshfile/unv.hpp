#pragma once
/// This function checks I-deas universal files before gmsh reads them.
#include <cstdint>
#include <string>

namespace squeal::meshfile {

/// The numbers of nodes and elements of a .unv file.
struct UnvContents {
  std::int64_t nodes = 0, elements = 0;
};

/// Not collective. Returns the contents of a .unv file. Throws Error, with the line, unless the
/// sections of nodes (2411) and elements (2412) hold tags that are positive and given once, finite
/// coordinates, and elements on existing nodes. Throws Error also if the names of two groups (2435,
/// 2452, 2477) begin with the same word, which is all that gmsh reads of a name. gmsh's reader
/// silently leaves a section at a line that it does not understand.
UnvContents requireSoundUnv(const std::string& file);

}  // namespace squeal::meshfile
