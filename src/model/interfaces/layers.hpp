// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Compliant layers on contact faces. A layer of the stiffness k, N/m³, lies between the nodes P of
/// a face and the layer nodes L, which have the gaps to the other side. Along the normal n, the
/// layer is a spring over the whole face [M.85],
///   E = ½ k ∫ (Σ φ_i n_i·(u_P,i − u_L,i))² dA,
/// Along the face, L moves with P; on a sticking interface, the layer is a spring along the face
/// instead. If the other side covers only a part of the integral of a shape function, the factor √k
/// of this function is reduced by the square root of the covered fraction.
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
