#pragma once
/// I-deas universal files, checked before gmsh reads them.
#include <cstdint>
#include <string>

namespace squeal::meshfile {

struct UnvContents {
  std::int64_t nodes = 0, elements = 0;
};

/// gmsh's reader of .unv files leaves a section where it meets a line that it does not understand,
/// without a word. Error, with the line, unless the sections of nodes (2411) and elements (2412)
/// are what they should be: tags that are positive and given once, finite coordinates, elements on
/// nodes that there are; or if two groups (2435, 2452, 2477) begin with the same word, which is all
/// that gmsh reads of a name. Not collective.
UnvContents requireSoundUnv(const std::string& file);

}  // namespace squeal::meshfile
