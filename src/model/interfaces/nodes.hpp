// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The nodes that touch or are tied, and their masters: from pairs of nodes if the meshes match,
/// otherwise from the coupling of the surfaces.
#include <array>
#include <string>
#include <vector>

#include "model/constraints/constraints.hpp"
#include "model/constraints/couplings.hpp"
#include "model/coupling/coupling.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/interfaces/gap_basis.hpp"
#include "model/interfaces/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// A node in contact, owned by this rank, on the slave side (the pad if the meshes match). On an
/// interface with a compliant layer it is a layer node. Contact nodes are in the order of local
/// nodes.
struct ContactNode {
  Point position;  ///< m
  Point normal;    ///< n, unit, from disc to pad
  Point slip;  ///< τ = w/|w|, or zero if w = 0; w = −V in the tangent plane, at the speed factor 1
  double slipSpeed;  ///< |w| at the speed factor 1, m/s
  double area;  ///< ∫ ψ dA > 0 over the covered part of the faces, m² (m in plane problems), with
                ///< the dual function ψ (mortar/dual.hpp); `wholeArea` if the meshes match
  double wholeArea;  ///< ∫ φ̃ dA over the faces of the slave, m² (m); φ̃: mortar/basis.hpp
  double gap;        ///< gap without load, m
  int interface;     ///< index into Interfaces::options
  Role role;         ///< never tied
  bool separates;    ///< false: its gap stays zero
  int side;          ///< +1 if the slave is the pad, −1 if it is the disc
  PetscInt node;     ///< local node with the gap
  PetscInt globalNode;   ///< global node with the gap
  PetscInt surfaceNode;  ///< local node on the face; differs from `node` if there is a layer
  PetscInt master;       ///< global node of the disc if the meshes match; otherwise −1
  int discBody;          ///< index into Mesh::bodies; −1 on a rigid obstacle
  /// parts of the master; none on a rigid obstacle
  std::vector<coupling::PartShare> masterParts;

  bool hasLayer() const { return surfaceNode != node; }
};

/// The coupling of a node i of the slave side with nodes l of the master side:
///   u_i = Σ_l P_il u_l + jump.
struct Connection {
  PetscInt node;  ///< local node
  /// 1 if no master is itself a slave, otherwise the largest level of its masters plus 1
  int level = 1;
  std::vector<coupling::Weight> masters;    ///< row of P; empty on a rigid obstacle
  std::vector<coupling::Weight> convected;  ///< weights, 1/s, of the displacements in
                                            ///< (V·∇) u_D; empty if the meshes match,
                                            ///< or if the slave is the disc
};

/// A tied node, owned by this rank.
struct TiedNode {
  int interface;  ///< index into Interfaces::options
  Connection connection;
  std::vector<coupling::PartShare> masterParts;
  Point offset;  ///< Σ P_il x_l − x_i, m: from the node to its position on the master, both as in
                 ///< the file
  /// [component] 1 if a support holds the component directly and the tie does not act on it.
  /// Normally a support of a tied node acts on its masters instead; if the resulting condition on
  /// the masters already follows from other conditions, the support holds the node itself.
  std::array<unsigned char, 3> apart{};
};

/// The slave side of an interface.
struct SlaveSide {
  std::string surface;  ///< group
  int sign;             ///< +1 if it is the pad, −1 if it is the disc
};

/// The nodes of an interface that have no condition there because another interface determines
/// their motion or their gap.
struct LossReport {
  PetscInt nodes = 0;
  Point first{};                    ///< position of one of them, m
  std::vector<std::string> owners;  ///< labels of these other interfaces
};

/// The cells that the adjustment of a tie stretches or compresses.
struct StrainReport {
  PetscInt cells = 0;  ///< cells in which the distance of two corners changes by more than 10 %
  double change = 0;   ///< largest relative change of the distance of two corners
  Point where{};       ///< midpoint of these two corners, with the coordinates of the file, m
};

/// A report on an interface, the same on all ranks.
struct InterfaceReport {
  bool matching = true;         ///< the meshes match node by node, or one side is a rigid obstacle
  std::string whyNot;           ///< text on where the meshes do not match
  bool nearlyMatching = false;  ///< the meshes do not match, but most nodes have a partner
  PetscInt nodes = 0;           ///< nodes in contact, or tied
  // If the meshes match, slave, master, coveredArea and largestGap are zero, except slave and
  // coveredArea of a tie.
  coupling::SideReport slave, master;
  double coveredArea = 0;  ///< of the slave, m² (m in plane problems)
  double largestGap = 0;   ///< largest distance between the touching surfaces, m
  PetscInt dropped = 0;    ///< touching nodes without a condition: too little covered, or left
                           ///< to another interface
  LossReport loss;
  /// Nodes of a contact that need no gap because a tie binds them to the opposite side.
  PetscInt bonded = 0;
  // The following apply only to ties.
  PetscInt carried = 0;  ///< held components of tied nodes; their supports act on the masters,
                         ///< unless TiedNode::apart is set
  PetscInt untied = 0;   ///< nodes of the slave without a condition, covered or not
  double largestAdjustment = 0;  ///< largest move of a tied node, m
  StrainReport strain;
};

/// A node that an interface leaves to another interface, owned by this rank.
struct LostNode {
  int interface;  ///< the interface that lost it, index into Interfaces::options
  PetscInt node;  ///< local node
};

/// The rigid obstacle of an interface; zero for an interface without one.
struct Obstacle {
  Point velocity{};      ///< m/s
  Point displacement{};  ///< m
};

/// All interfaces with their nodes. [interface] has the same indices as Mesh::interfaces.
struct Interfaces {
  std::vector<std::string> names;          ///< [interface]
  std::vector<InterfaceSettings> options;  ///< [interface], contact first, then ties
  std::vector<Obstacle> obstacles;         ///< [interface]
  std::vector<SlaveSide> slaves;           ///< [interface]
  std::vector<InterfaceReport> reports;    ///< [interface]
  std::vector<ContactNode> nodes;          ///< owned by this rank
  std::vector<Connection> connections;     ///< [contact node]
  std::vector<TiedNode> tied;              ///< owned by this rank, in the order of local nodes
  std::vector<LostNode> lost;              ///< owned by this rank
  constraints::Constraints constraints;
  std::vector<constraints::CouplingName> couplings;  ///< names of the couplings, then of the bolts
  std::vector<constraints::CoupledNode> coupled;     ///< owned by this rank, by local node
  PetscInt totalNodes = 0;                           ///< contact nodes of all ranks
  /// [local node] contact interface with a gap at the node, index into `options`; −1 if there is
  /// none. Includes ghosts and periodic images.
  std::vector<int> interfaceOf;
  int levels = 1;                       ///< largest level of any connection on any rank
  GapBasis gapBasis;                    ///< E
  std::vector<mesh::LayerNode> layers;  ///< those with a gap, including periodic images
  /// N×N, exchanges each node below a compliant layer with its layer node; null without layers
  OwnedMat layerExchange;

  /// Returns true if two interfaces slide on the same surface of a disc. A node that they share
  /// then has the same gap on both.
  bool slideTogether(int one, int other) const;
  /// Returns true if the local node has a gap on the slave surface of this name.
  bool hasGapOn(const std::string& surface, PetscInt node) const;
  /// Returns the slave side of the contact interface whose slave surface has this name, borrowed;
  /// null if there is none.
  const SlaveSide* slaveOf(const std::string& surface) const;
  /// Returns the labels of the interfaces whose `marks`, [interface], are not zero.
  std::vector<std::string> labels(const std::vector<int>& marks) const;
};

/// Returns a line for the log on the nodes of an interface and the coupling of its sides.
std::string describe(const Interfaces& all, int interface);

/// Collective. Adds the nodes in contact to `ties`, the result of findTies(). A node belongs to
/// only one interface. Ties take precedence over sliding interfaces, and these over sticking and
/// frictionless ones. `periodic`, N×N, copies the displacements of primaries to their images.
/// Throws Error for surfaces that do not meet, for a node in two interfaces that slide on different
/// discs, and for slaves that depend on each other in a circle.
Interfaces findNodes(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, Mat periodic,
                     Interfaces ties);

}  // namespace squeal::interfaces
