// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Couplings of reference nodes with groups of nodes.
#include <array>
#include <string>
#include <vector>

#include "model/constraints/settings.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::constraints {

using mesh::Matrix3;
using mesh::Point;

/// A node that a coupled node follows.
struct CoupledMaster {
  PetscInt node;    ///< global node
  Matrix3 block;    ///< factors, [component of the follower][component of this node]
  int part;         ///< index into Mesh::partName
  Point position;   ///< m
  bool isRotation;  ///< its components are a rotation
};

/// A node that follows others, owned by this rank:
///   u = own z + Σ block u_master,
/// where z are the components of the node that stay free. In plane problems only the first two rows
/// and columns of the blocks are used, and the rotation of a reference node is stored as a first
/// component.
struct CoupledNode {
  PetscInt node;             ///< local node
  int coupling;              ///< index into Settings::couplings followed by Settings::bolts
  bool distributed = false;  ///< true for the reference node of a distributed coupling
  Matrix3 own{};             ///< [component][component of z]
  std::array<unsigned char, 3> free{};  ///< [component of z] 1 if it is an unknown
  /// 1 if no master depends on others, otherwise the largest level of its masters plus 1
  int level = 1;
  std::vector<CoupledMaster> masters = {};
};

/// The name of a coupling or a bolt.
struct CouplingName {
  std::string kind, name;  ///< kind: coupling or bolt
  /// Returns "coupling 'hub'", for messages.
  std::string label() const { return kind + " '" + name + "'"; }
};

/// Returns the names of the couplings and bolts, [CoupledNode::coupling].
std::vector<CouplingName> couplingNames(const Settings& settings);

/// Collective. Returns the coupled nodes in the order of local nodes. A node of a rigid coupling
/// follows its reference node, u = u_R + θ_R × (x − x_R), in the coupled components. The reference
/// node of a distributed coupling follows the nodes of the groups with the weights w:
///   u_R = ū + θ_R × (x_R − x̄),   θ_R = T⁻¹ Σ w r × u,   T = Σ w (|r|² 1 − r rᵀ),
/// where ū and x̄ are weighted means and r = x − x̄. This motion minimises Σ w |u − u_R − θ_R × (x
/// − x_R)|². Throws Error, naming the coupling, for a group without nodes, for a node that follows
/// two couplings or has a periodic image, and for groups whose nodes do not determine the rotation.
std::vector<CoupledNode> coupledNodes(const mesh::Mesh& mesh, const Settings& settings);

}  // namespace squeal::constraints
