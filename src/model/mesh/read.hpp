#pragma once
/// This function reads the mesh and hands each rank its part.
#include "model/mesh/mesh.hpp"

namespace squeal::mesh {

/// Collective. Reads `-mesh_file`, or meshes it if it is a .geo, through the gmsh library on rank
/// 0; splits nodes shared across contact interfaces, pairs contact and periodic nodes, partitions
/// with METIS and sends each rank its part. Only rank 0 holds the whole mesh. Throws Error on all
/// ranks for an unreadable file, a missing group, a cell without material, a surface that bounds no
/// body, and periodic nodes without a partner. Contact sides that do not match are marked.
Mesh read(MPI_Comm comm, const Request& request);

}  // namespace squeal::mesh
