// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Ties with matching meshes, which make displacements equal: u_i = u_l. Either node may follow the
/// other, so a node with a gap or with several masters can stay independent while its partner
/// follows it.
#include "model/coupling/exchange.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::ties {

/// Collective. Adds the tied nodes of all ties with matching meshes to Interfaces::tied, after
/// those of the other ties. In each set of nodes with equal displacements, the nodes that another
/// tie already ties to several masters follow no node of the set. If there are none, one node of
/// the set is independent: preferably one on the slave side of a contact, otherwise a master. The
/// other nodes follow. Sets InterfaceReport::nodes of these ties and adds to Interfaces::lost.
/// Throws Error for a tie whose nodes are all tied by other ties already.
void tieMatched(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                interfaces::Interfaces& all);

}  // namespace squeal::ties
