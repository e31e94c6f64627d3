// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Repetition of surfaces on a periodic mesh: a surface that ends at one end of the mesh continues
/// at the other end.
#include <vector>

#include "model/mesh/mesh.hpp"
#include "model/mortar/face.hpp"

namespace squeal::coupling {

/// Collective. Returns the translations, m, by which faces of these surfaces repeat: the shifts
/// from primaries to images on all connected parts of the mesh with such faces, the opposite
/// shifts, and the differences of two shifts. The list is empty if there are no images.
std::vector<mesh::Point> translations(const mesh::Mesh& mesh,
                                      const std::vector<mortar::Face>& first,
                                      const std::vector<mortar::Face>& second);

/// Returns the faces, followed by copies shifted by each translation. Copies have the node numbers
/// of the originals. Not collective.
std::vector<mortar::Face> repeated(std::vector<mortar::Face> faces,
                                   const std::vector<mesh::Point>& translations);

}  // namespace squeal::coupling
