// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reference nodes. Not collective: for rank 0 only.
#include "model/mesh/gmsh_model.hpp"
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Adds the nodes of the reference nodes, those of sections last. Throws Error for a name that a
/// group of the mesh has.
void addReferences(WholeMesh& mesh, const GmshModel& model, const Request& request);

}  // namespace squeal::mesh
