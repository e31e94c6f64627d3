#pragma once
/// This function pairs nodes: periodic images with their primaries, and contact nodes of pad and
/// disc. It is for rank 0 only.
#include "mesh/mesh.hpp"
#include "mesh/whole.hpp"

namespace squeal::mesh {

/// Finds the partner of each periodic image and of each contact node, and fills primary, images and
/// pairs of the mesh.
void pairNodes(WholeMesh& mesh, const Request& request);

}  // namespace squeal::mesh
