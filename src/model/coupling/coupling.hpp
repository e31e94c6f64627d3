// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A Coupling ties the nodes of a slave surface to a master surface whose mesh does not match:
///   u_i = Σ_l P_il u_l + (G J)_i,
/// where l are nodes of the master, and also nodes of the slave that carry no condition. J_j is the
/// mean jump that the pivot j sees, and G combines these to jumps at nodes. Images of periodic
/// nodes are replaced by their primaries.
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

/// The share of a connected part in what a node rests on.
struct PartShare {
  int part;
  double share;
};

/// A node of the slave surface that carries a condition, a pivot, owned by this rank. With D, W, B
/// and M of FaceTerms summed over the faces around the pivots,
///   ũ_j = D_j⁻¹ (Σ M_jl u_l − Σ B_jo u_o) + (W_j / D_j) J_j,   u = E ũ.
struct SlaveNode {
  PetscInt node = 0;                   ///< local node
  std::vector<Weight> masters;         ///< row of P
  std::vector<Weight> jumps;           ///< row of G, on pivots
  std::vector<Weight> jumpsOf;         ///< row of G⁻¹, on pivots
  std::vector<Weight> convected;       ///< (V·∇) u_D at the node, 1/s; empty without a velocity
  std::vector<PartShare> masterParts;  ///< shares of the master's parts, none zero, sum 1
  int masterBody = -1;                 ///< index into Mesh::bodies of the largest share
  double area = 0;                     ///< W: ∫ ψ dA over the covered part, m² (m in the plane)
  double wholeArea = 0;                ///< ∫ φ̃ dA over all faces, covered or not, m² (m)
  double gap = 0;  ///< mean distance of the master from the slave along the slave's normal, m
  /// Σ P_il x_l − x_i, m: the way from the node to its place on the master. Where l stands for a
  /// periodic image, x_l is the place of the image.
  Point offset{};
};

/// The faces found on one side of an interface, summed over all ranks.
struct SideReport {
  PetscInt faces = 0;      ///< faces of the group
  PetscInt nearFaces = 0;  ///< those near the other side
  double area = 0;         ///< area of all faces, m² (m in the plane)
  double nearArea = 0;     ///< area of those near the other side, m² (m)
};

struct Coupling {
  std::vector<SlaveNode> nodes;  ///< pivots owned by this rank, in the order of local nodes
  SideReport slave, master;
  double coveredArea = 0;  ///< of the slave, m² (m)
  /// Nodes of slave faces that are covered in part that carry no condition: they are excluded, or
  /// less than a hundredth of their own area is covered.
  PetscInt droppedNodes = 0;
  /// Those of this rank that are excluded, local nodes.
  std::vector<PetscInt> excluded;
  PetscInt sliverFaces = 0;  ///< faces covered by too little to have dual functions: lumped
  double largestGap = 0;     ///< largest |gap| of an integration point, m
};

/// The surfaces of an interface and how far apart they may be.
struct Interface {
  std::string slave, master;  ///< surface groups
  /// Largest distance of two points that touch, m; zero stands for half the size of the face.
  double searchDistance = 0;
};

/// Returns the velocity of the matter of a body at a point, m/s; the body is an index into
/// Mesh::bodies.
using BodyVelocity = std::function<Point(int body, const Point& x)>;

/// Collective. Couples the surfaces of an interface. `velocity` is that of the convective terms; it
/// may be empty. Nodes of the slave with excluded[local node] set, the same on all ranks that have
/// the node, carry no condition. The same coupling results on any number of ranks, to rounding.
/// Throws Error for a slave face whose normal turns by more than 84°.
Coupling couple(const mesh::Mesh& mesh, const NodeExchange& exchange, const Interface& interface,
                const BodyVelocity& velocity, const std::vector<unsigned char>& excluded);

/// Collective. Returns which side has the smaller mean area of the faces that are near the other
/// one: true if it is the master. Slaves should be the finer side.
bool masterIsFiner(const mesh::Mesh& mesh, const Interface& interface);

}  // namespace squeal::coupling
