// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reference nodes. Not collective: for rank 0 only.
#include "model/mesh/gmsh_model.hpp"
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Adds two nodes to the mesh for each reference node; the reference nodes of sections come last.
/// Throws Error for a reference node with the name of a group of the mesh.
void addReferences(WholeMesh& mesh, const GmshModel& model, const Request& request);

}  // namespace squeal::mesh
