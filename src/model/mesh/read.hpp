// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reads the mesh and distributes it over the ranks.
#include "model/mesh/mesh.hpp"
#include "model/mesh/settings.hpp"
#include "model/mesh/straighten.hpp"
#include "model/meshfile/reader.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::mesh {

/// Collective. On rank 0, `reader` reads the file, or meshes it if it is a geometry or a shape.
/// Nodes that the two sides of a contact interface share are split, contact and periodic nodes are
/// paired, and each rank receives its part of a METIS partition. Only rank 0 stores the whole mesh.
/// Throws Error on all ranks for an unreadable file, a missing group, a cell without material, a
/// surface that bounds no body, and periodic nodes without a partner. Interfaces whose sides do not
/// match are marked (InterfaceMatch). Settings::straightening needs `geometry`.
Mesh read(MPI_Comm comm, const Request& request, const meshfile::Settings& file,
          const Settings& settings, const CellGeometry& geometry,
          meshfile::Reader reader = meshfile::readInProgram);

}  // namespace squeal::mesh
