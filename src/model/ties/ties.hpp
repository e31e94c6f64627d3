// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Ties, and the moves of tied nodes onto their masters. Ties are found before the elements are
/// assembled, because these moves change the mesh. A tie u_i = Σ P_il u_l is exact for a rotation
/// of both sides together only if its nodes satisfy
///   x_i = Σ P_il x_l   [M.55].
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::ties {

/// Collective. Returns the supports, the tied nodes, the coupled nodes, and the options of all
/// interfaces. A node belongs to only one tie. Among ties whose meshes do not match, it belongs to
/// the first one that claims it; for ties with matching meshes, see tieMatched(). Unless adjusting
/// is off for a tie, its slave nodes are moved: they then satisfy the equation above with the
/// returned P, within round-off. Warns of a tie if less than half of its slave surface is covered.
/// Throws Error for surfaces that do not meet, for ties that depend on each other in a circle, and
/// for a tie that folds a cell.
interfaces::Interfaces findTies(mesh::Mesh& mesh, const interfaces::Settings& settings,
                                const constraints::Settings& supports);

/// Returns a line on the ties of all ranks, for the log; empty if there are none.
std::string describeTies(const interfaces::Interfaces& ties);

}  // namespace squeal::ties
