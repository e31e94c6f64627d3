// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Ties whose meshes match make displacements equal: u_i = u_l. Which of the two nodes follows the
/// other is free, so that a node that has a gap, or that rests on several nodes of a master, can
/// stay independent while its partner follows it.
#include "model/coupling/exchange.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::ties {

/// Collective. Adds the tied nodes of all ties whose meshes match to Interfaces::tied, after those
/// of the other ties. In each set of nodes with equal displacements, one node is independent: one
/// that rests on several nodes, otherwise one on the slave side of a contact, otherwise a master.
/// Sets InterfaceReport::nodes and InterfaceReport::lost of these ties. Throws Error for a tie all
/// of whose nodes are tied by others.
void tieMatched(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                interfaces::Interfaces& all);

}  // namespace squeal::ties
