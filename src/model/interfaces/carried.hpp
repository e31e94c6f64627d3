// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Supports of tied nodes. A tied node follows its masters, so a support of the node acts on the
/// masters: Σ_l P_il u_l = ū in the held components.
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Collective. Solves these equations for components of the masters. A component with a definite
/// value is held: Constraints::held. Others depend on components of further masters:
/// Constraints::combined. If an equation depends on those of other nodes within `leastPivot`, the
/// support holds the tied node and constrains no master: TiedNode::apart. Sets
/// InterfaceReport::carried. Throws Error, naming support, tie and position, for contradictory
/// displacements, and for a component that would depend on contact nodes.
void transferSupports(const mesh::Mesh& mesh, Interfaces& all);

/// The least weight of a pivot in its equation. With a smaller bound, nodes between the held ones
/// would be held too, by equations that differ only by quadrature errors.
constexpr double leastPivot = 0.05;

}  // namespace squeal::interfaces
