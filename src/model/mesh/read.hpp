// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reads the mesh and distributes it over the ranks.
#include "model/mesh/mesh.hpp"
#include "model/mesh/settings.hpp"
#include "model/mesh/straighten.hpp"
#include "model/meshfile/reader.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::mesh {

/// Collective. Reads the file, or meshes it if it is a .geo, by `reader` on rank 0; splits nodes
/// shared across contact interfaces, pairs contact and periodic nodes, partitions with METIS and
/// sends each rank its part. Only rank 0 holds the whole mesh. Throws Error on all ranks for an
/// unreadable file, a missing group, a cell without material, a surface that bounds no body, and
/// periodic nodes without a partner. Contact sides that do not match are marked.
/// `geometry` is for Settings::straightening.
Mesh read(MPI_Comm comm, const Request& request, const meshfile::Settings& file,
          const Settings& settings, const CellGeometry& geometry,
          meshfile::Reader reader = meshfile::readInProgram);

}  // namespace squeal::mesh
