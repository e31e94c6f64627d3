// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Ties whose meshes match make displacements equal: u_i = u_l. Either node may follow the other,
/// so a node with a gap or with several masters can stay independent while its partner follows it.
#include "model/coupling/exchange.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::ties {

/// Collective. Adds the tied nodes of all ties with matching meshes to Interfaces::tied, after
/// those of the other ties. In each set of nodes with equal displacements, one node is independent:
/// a node with several masters, otherwise one on the slave side of a contact, otherwise a master.
/// Sets InterfaceReport::nodes and InterfaceReport::lost of these ties. Throws Error for a tie
/// whose nodes are all tied by others.
void tieMatched(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                interfaces::Interfaces& all);

}  // namespace squeal::ties
