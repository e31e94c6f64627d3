// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A support may hold components of nodes that are tied. As the node follows its masters, the
/// support then acts on them: Σ_l P_il u_l = ū in these components.
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Collective. Solves these equations for components of the masters. Those with a value of their
/// own are held: Constraints::held. Others follow from components of further masters:
/// Constraints::combined. Where an equation follows from those of other nodes up to less than
/// `leastPivot`, the support holds the tied node and constrains no master:
/// TiedNode::apart. Sets InterfaceReport::carried. Throws Error, naming support, tie and place, for
/// displacements that contradict each other, and for a component that would follow from those of
/// contact nodes.
void carryHeld(const mesh::Mesh& mesh, Interfaces& all);

/// The least weight of a master in the equation that is solved for it. Below it, the nodes between
/// those that are held would be held as well, by equations that differ by quadrature only.
constexpr double leastPivot = 0.05;

}  // namespace squeal::interfaces
