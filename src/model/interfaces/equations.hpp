// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Equations between components of nodes: those of the options, and supports of nodes that follow
/// others. A tied node follows its masters, so a support of the node acts on the masters: Σ_l P_il
/// u_l = ū in the held components. The same applies to the reference node of a distributed
/// coupling.
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Collective. Solves these equations for components of nodes that follow no others. A component
/// whose value they determine is held (Constraints::held). Other components depend on components
/// of further nodes (Constraints::dependent). If the equation for a support of a tied node follows
/// from the other equations, up to weights below `leastPivot`, the support holds the tied node
/// itself and constrains no master (TiedNode::apart). Sets InterfaceReport::carried. Throws Error,
/// naming support or equation and position, for contradictory equations, and for a component that
/// would depend on contact nodes.
void solveEquations(const mesh::Mesh& mesh, Interfaces& all);

/// The smallest weight of a pivot in the equation of a support of a tied node, relative to the
/// largest weight there. With a smaller bound, equations that differ only by quadrature errors
/// would also hold nodes that lie between the held ones.
constexpr double leastPivot = 0.05;

}  // namespace squeal::interfaces
