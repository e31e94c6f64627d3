// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Nodes that an interface has to leave to another one: a node has one gap, and it follows from one
/// set of masters.
#include "model/coupling/exchange.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Collective. Returns the area of the slave of an interface that belongs to its lost nodes,
/// Σ ∫ |φ| dA, m² (m in the plane).
double areaOfLost(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                  const Interfaces& all, int interface);

/// Collective. Warns of the nodes that ties (Role::tied), or interfaces in contact (any other
/// role), have lost, with their number, area, place and the remedy. Nodes whose condition is met
/// all the same are no loss: those that follow a node with the same gap, and those that are tied to
/// what they are in contact with.
void warnOfLost(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Interfaces& all,
                Role role);

}  // namespace squeal::interfaces
