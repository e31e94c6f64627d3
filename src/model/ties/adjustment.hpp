// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Moves the nodes of ties onto their masters.
#include "model/coupling/exchange.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::ties {

/// Collective. Moves the tied nodes of adjusted ties to Σ P_il x_l; in chains of ties, masters are
/// moved before their slaves. P is that of the original coupling. A P computed from the moved nodes
/// would shift them again along the surface, by about a hundredth of the first move, and repeated
/// moves would not end. Nodes within edges, faces and cells follow the corners of their cells,
/// unless they are on a surface that options name. Periodic images move with their primaries. Sets
/// InterfaceReport::largestAdjustment and InterfaceReport::strain. Throws Error for a tie that
/// folds a cell, and warns of a tie that changes a distance between corners of a cell by more than
/// a tenth.
void moveOntoMasters(mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                     interfaces::Interfaces& ties);

}  // namespace squeal::ties
