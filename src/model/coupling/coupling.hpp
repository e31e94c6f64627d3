// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Coupling of the nodes of a slave surface to a master surface whose mesh does not match:
///   u_i = Σ_l P_il u_l + (G J)_i,
/// where l are nodes of the master, and also nodes of the slave without such a condition. The nodes
/// of the slave with a condition are called pivots. J_j is the mean jump at the pivot j, and G maps
/// mean jumps to jumps at nodes. Periodic images are replaced by their primaries.
#include <functional>
#include <string>
#include <vector>

#include "model/coupling/exchange.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::coupling {

using mesh::Point;

/// A term of a sum over nodes.
struct Weight {
  PetscInt node;  ///< global node
  double value;
};

/// The share of a connected part of the mesh in the masters of a node.
struct PartShare {
  int part;
  double share;
};

/// A pivot owned by this rank. With D, W, B and M of FaceTerms, summed over the faces around the
/// pivots, and with the edge matrix E of docs/method.md [M.12],
///   ũ_j = D_j⁻¹ (Σ M_jl u_l − Σ B_jo u_o) + (W_j / D_j) J_j,   u = E ũ.
struct SlaveNode {
  PetscInt node = 0;                   ///< local node
  std::vector<Weight> masters;         ///< row of P
  std::vector<Weight> jumps;           ///< row of G; its nodes are pivots
  std::vector<Weight> jumpsOf;         ///< row of G⁻¹; its nodes are pivots
  std::vector<Weight> convected;       ///< (V·∇) u_D at the node, 1/s; empty without a velocity
  std::vector<PartShare> masterParts;  ///< nonzero shares of the master's parts, with the sum 1
  int masterBody = -1;                 ///< body with the largest share, index into Mesh::bodies
  double area = 0;       ///< W: ∫ ψ dA over the covered part, m² (m in plane problems)
  double wholeArea = 0;  ///< ∫ φ̃ dA over all faces, covered or not, m² (m)
  double gap = 0;        ///< mean gap between slave and master along the slave's normal, m
  /// Σ P_il x_l − x_i, m: the vector from the node to its position on the master. For a periodic
  /// image l, x_l is the position of the image.
  Point offset{};
};

/// The faces on one side of an interface, summed over all ranks.
struct SideReport {
  PetscInt faces = 0;      ///< faces of the group
  PetscInt nearFaces = 0;  ///< faces near the other side
  double area = 0;         ///< area of all faces, m² (m in plane problems)
  double nearArea = 0;     ///< area of the faces near the other side, m² (m)
};

struct Coupling {
  std::vector<SlaveNode> nodes;  ///< pivots owned by this rank, in the order of local nodes
  SideReport slave, master;
  double coveredArea = 0;  ///< of the slave, m² (m)
  /// Number of nodes without a condition at slave faces that are at least partly covered. These
  /// nodes are excluded, or less than a hundredth of their area is covered.
  PetscInt droppedNodes = 0;
  /// Those of the dropped nodes that are excluded, as local nodes owned by this rank.
  std::vector<PetscInt> excluded;
  /// Number of faces with too small a covered part for dual functions; their terms are lumped.
  PetscInt sliverFaces = 0;
  double largestGap = 0;  ///< largest |gap| at an integration point, m
};

/// The surfaces of an interface and the search distance between them.
struct Interface {
  std::string slave, master;  ///< surface groups
  /// Largest distance of two touching points, m; zero: half the size of the face.
  double searchDistance = 0;
};

/// Returns the velocity of the matter of a body at a point, m/s. `body` is an index into
/// Mesh::bodies.
using BodyVelocity = std::function<Point(int body, const Point& x)>;

/// Collective. Couples the surfaces of an interface. `velocity`, which may be empty, is used for
/// the convective terms. Nodes of the slave with excluded[local node] set get no condition; the
/// flag must be the same on all ranks that have the node. Within round-off, the result does not
/// depend on the number of ranks. Throws Error for a slave face whose normal turns by more than
/// 84°.
Coupling couple(const mesh::Mesh& mesh, const NodeExchange& exchange, const Interface& interface,
                const BodyVelocity& velocity, const std::vector<unsigned char>& excluded);

/// Collective. Returns true if the master is clearly finer than the slave: if the mean area of its
/// faces near the other side is less than 0.8 of that of the slave. The slave should be the finer
/// side.
bool masterIsFiner(const mesh::Mesh& mesh, const Interface& interface);

}  // namespace squeal::coupling
