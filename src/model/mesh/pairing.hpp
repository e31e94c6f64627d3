// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Pairs of nodes: periodic images with their primaries, and contact nodes of pad and disc. For
/// rank 0 only.
#include "model/mesh/mesh.hpp"
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Finds the partner of each periodic image and of each contact node, and fills primary, images,
/// pairs and interfaces of the mesh. An interface gets no pairs if the meshes of its sides do not
/// match. Throws Error for an image without a partner, for images whose mesh differs from that of
/// their primaries, for images that follow each other in a circle, and for a pad surface that is
/// also its own disc surface.
void pairNodes(WholeMesh& mesh, const Request& request);

}  // namespace squeal::mesh
