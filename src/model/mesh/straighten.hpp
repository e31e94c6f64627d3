#pragma once
/// This function straightens the edges of curved cells. Not collective: for rank 0 only.
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Straightens cells as `-mesh_straighten` says: none, those that are folded, or all. It moves
/// their nodes other than corners to the places that `geometry` gives. Cells that share these nodes
/// follow, and so do images, primaries and partners in contact, which are moved alike; images and
/// pairs must be known. A cell that this folds is straightened in another round. Fills
/// WholeMesh::straightened.
void straighten(WholeMesh& mesh, const CellGeometry& geometry);

}  // namespace squeal::mesh
