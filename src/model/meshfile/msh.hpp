// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of files in gmsh's mesh format before gmsh reads them.
#include <cstdint>
#include <string>

namespace squeal::meshfile {

/// The version of a .msh file and the numbers of its nodes and elements.
struct MshContents {
  double version = 0;
  std::int64_t nodes = 0, elements = 0;
};

/// Not collective. Returns the contents of a .msh file of version 2 to 2.2, 4 or 4.1, ASCII or
/// binary. Throws Error, with the line (or the byte in a binary file), unless the sections $Nodes
/// and $Elements have as many entries as their headers announce, with tags that are positive and
/// given once, finite coordinates, and elements of known types on existing nodes. gmsh's reader
/// does not check this. In a wrong file, it writes beyond its arrays, stops early without a
/// message, or uses -1 as a node.
MshContents requireSoundMsh(const std::string& file);

}  // namespace squeal::meshfile
