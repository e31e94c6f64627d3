// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Compliant layers on contact faces. A layer of stiffness k, N/m³, lies between the nodes P of a
/// face and the layer nodes L, which have the gaps to the other side. Along the normal n, the layer
/// is a spring over the whole face with the energy [M.85]
///   E = ½ k ∫ (Σ φ_i n_i·(u_P,i − u_L,i))² dA.
/// Along the face, L moves with P, except on a sticking interface, where the layer is also a spring
/// along the face. If the other side covers only part of the area of a node i, the term of i in the
/// sum is multiplied by the square root of the covered fraction (ContactNode::area over wholeArea).
#include <vector>

#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Collective. Returns the layer nodes of this rank with a gap, including images. On interfaces
/// with a layer, the contact nodes of `all` are layer nodes.
std::vector<mesh::LayerNode> layersInContact(const mesh::Mesh& mesh, const Interfaces& all,
                                             Mat periodic);

/// Collective. Returns the N×N permutation that exchanges each node of `all.layers` with its node
/// on the face; null without layers.
OwnedMat layerExchange(const mesh::Mesh& mesh, const Interfaces& all);

/// Collective. Returns the stiffness of `all.layers`, N×N, symmetric, N/m; null without layers.
OwnedMat layerStiffness(const mesh::Mesh& mesh, const Interfaces& all, Mat periodic);

}  // namespace squeal::interfaces
