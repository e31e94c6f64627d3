#pragma once
/// This function pairs nodes: periodic images with their primaries, and contact nodes of pad and
/// disc. It is for rank 0 only.
#include "mesh/mesh.hpp"
#include "mesh/whole.hpp"

namespace squeal::mesh {

/// Finds the partner of each periodic image and of each contact node, and fills primary, images and
/// pairs of the mesh. Throws Error for a node without a partner, for groups and faces that are not
/// meshed alike, for images that go round in a circle, and for a pad node that belongs to two
/// interfaces or is a disc node too.
void pairNodes(WholeMesh& mesh, const Request& request);

}  // namespace squeal::mesh
