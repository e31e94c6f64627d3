// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// On a periodic mesh a surface goes on beyond its end: what leaves the mesh there comes in again
/// at the other end.
#include <vector>

#include "model/mesh/mesh.hpp"
#include "model/mortar/face.hpp"

namespace squeal::coupling {

/// Collective. Returns the ways, m, by which faces of these surfaces are repeated: those from
/// primaries to their images on the connected parts of the mesh that bear the faces, the opposite
/// ones, and their differences. Empty without images.
std::vector<mesh::Point> translations(const mesh::Mesh& mesh,
                                      const std::vector<mortar::Face>& first,
                                      const std::vector<mortar::Face>& second);

/// Returns the faces, followed by copies that are moved by each translation. Copies have the node
/// numbers of the originals. Not collective.
std::vector<mortar::Face> repeated(std::vector<mortar::Face> faces,
                                   const std::vector<mesh::Point>& translations);

}  // namespace squeal::coupling
