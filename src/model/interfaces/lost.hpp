// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Lost nodes: nodes that an interface leaves to another one, since a node has at most one gap and
/// one set of masters.
#include "model/coupling/exchange.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Collective. Returns the area Σ ∫ |φ| dA of the lost nodes on the slave of an interface, m² (m in
/// the plane).
double areaOfLost(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                  const Interfaces& all, int interface);

/// Collective. Reports the lost nodes of ties (Role::tied) or of interfaces in contact (any other
/// role) in InterfaceReport::loss, and warns of them with number, area, position and remedy. Lost
/// nodes whose condition is satisfied nevertheless are not counted: nodes that follow a node with
/// the same gap, and nodes that are tied to the touching surface (InterfaceReport::bonded). Throws
/// Error if all nodes of a contact are bonded.
void warnOfLost(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Interfaces& all,
                Role role);

}  // namespace squeal::interfaces
