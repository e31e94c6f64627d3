// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Lost nodes: nodes that an interface leaves to another one, since a node has at most one gap and
/// one set of masters.
#include "model/coupling/exchange.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Collective. Returns the area Σ ∫ φ̃ dA of the lost nodes on the slave of an interface, m² (m in
/// plane problems); for φ̃ see model/mortar/basis.hpp.
double areaOfLost(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                  const Interfaces& all, int interface);

/// Collective. Reports the lost nodes of ties (Role::tied) or of interfaces in contact (any other
/// role) in InterfaceReport::loss, and warns of them with number, area, position and remedy. Omits
/// lost nodes that need no condition on the interface: those with the same gap and friction on
/// another interface, and bonded nodes (InterfaceReport::bonded). Throws Error if all nodes of a
/// contact are bonded.
void warnOfLost(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Interfaces& all,
                Role role);

}  // namespace squeal::interfaces
