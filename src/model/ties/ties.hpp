// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Ties, found before elements are made, and the moves of tied nodes onto their masters.
/// A tie u_i = Σ P_il u_l is exact for a rotation of both sides together only if its nodes satisfy
///   x_i = Σ P_il x_l   [M.55].
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::ties {

/// Collective. Returns the options of all interfaces, the constraints and the tied nodes. A node
/// follows by one tie: the first that claims it where the meshes do not match, otherwise by
/// tieMatched(). The nodes of ties that are
/// adjusted are moved so that the equation above holds to rounding with the P that is returned.
/// Warns of ties of which less than half of the slave is covered. Throws Error for surfaces that do
/// not meet, for ties that rest on each other in a circle, and for a tie that folds a cell.
interfaces::Interfaces findTies(mesh::Mesh& mesh, const interfaces::Settings& settings);

/// Returns a line on the ties of all ranks, for the log; empty if there are none.
std::string describeTies(const interfaces::Interfaces& ties);

}  // namespace squeal::ties
