// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A Mesh is the distributed finite element mesh, with the geometry and the names for all later
/// stages.
#include <petscsys.h>

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/options/option_types.hpp"

namespace squeal::mesh {

using Point = std::array<double, 3>;

/// A CellBlock holds the cells of one gmsh element type on this rank. A cell belongs to one rank,
/// and all of its nodes are local nodes there.
struct CellBlock {
  int type = 0;  ///< gmsh element type
  int nodesPerCell = 0;
  std::vector<PetscInt> nodes;     ///< [cell][node] local node, in gmsh's order
  std::vector<int> body;           ///< [cell] index into Mesh::bodies
  std::vector<PetscInt> tag;       ///< [cell] gmsh's element tag
  std::vector<int> material = {};  ///< [cell] index into Mesh::materialGroups

  std::span<const PetscInt> nodesOf(std::size_t cell) const {
    return std::span(nodes).subspan(cell * nodesPerCell, nodesPerCell);
  }
};

/// A FaceBlock holds the boundary faces of one gmsh element type, from the surface groups that
/// options name. A face is on the rank of the cell that it bounds. If pad and disc share nodes in
/// the file, the group of the pad has the faces of the cells whose body has no motion
/// (Request::moving). The group of the disc has the faces of the moving cells, unless it is also
/// the group of a pad.
struct FaceBlock {
  int type = 0;
  int nodesPerFace = 0;
  std::vector<PetscInt> nodes;  ///< [face][node] local node
  std::vector<int> surface;     ///< [face] index into Mesh::surfaces
  /// [face] +1 if the normal by node order points out of the cell, −1 if it points into it
  std::vector<int> sign;

  std::span<const PetscInt> nodesOf(std::size_t face) const {
    return std::span(nodes).subspan(face * nodesPerFace, nodesPerFace);
  }
};

/// A node of this rank that repeats the displacement of another node (periodicity).
struct Image {
  PetscInt node;     ///< local node (owned)
  PetscInt primary;  ///< global node
  Point shift;       ///< position of the image minus that of the primary, m
  int primaryPart;   ///< connected part of the primary
};

/// A contact node of the pad (slave) and the disc node at the same place (master).
struct ContactPair {
  PetscInt node;    ///< local node of the pad side (owned)
  PetscInt master;  ///< global node of the disc side; −1 for a rigid obstacle
  int interface;    ///< index into Mesh::interfaces
  int masterBody;   ///< index into Mesh::bodies of the disc side; −1 for a rigid obstacle
  int masterPart;   ///< connected part of the master node; −1 for a rigid obstacle
  Point offset;     ///< position of the master minus that of the node, as in the mesh file, m
};

/// A volume group whose cells have one material: a body without sections, or a section of a body.
struct MaterialGroup {
  std::string name;
  int body;        ///< index into Mesh::bodies
  bool isSection;  ///< false: it is the whole body, and has its name
};

/// A cut through a body, for example across the shank of a bolt; the sections of MaterialGroup, in
/// contrast, are volumes. The two sides of the cut move apart by the displacement of a reference
/// node.
struct Section {
  std::string name;
  Point normal;   ///< unit, from the lower side to the upper one
  int reference;  ///< index into Mesh::references
};

/// Two nodes at the same place, one on each side of a section.
struct SectionPair {
  PetscInt node;   ///< local node of the upper side (owned)
  PetscInt lower;  ///< global node of the lower side
  int section;     ///< index into Mesh::sections
  int lowerPart;   ///< connected part of the lower node
};

/// A node of a compliant layer. It belongs to no cell and has the same position as a node on a
/// surface; the layer is between these two nodes.
struct LayerNode {
  PetscInt node;   ///< local node on the surface (owned)
  PetscInt layer;  ///< local node (owned)
};

/// How the meshes of the two sides of an interface fit together.
struct InterfaceMatch {
  std::string label;  ///< label of the request, the key of the interface
  /// True if the faces of the pad coincide with faces of the disc, node by node, or if the pad is
  /// on a rigid obstacle. Otherwise the interface has no pairs.
  bool matching = true;
  /// Where and why the meshes do not match, without full stop; empty if they match.
  std::string mismatch;
  /// True if the meshes do not match, but most nodes of the pad have a partner.
  bool nearlyMatching = false;
};

/// The changes that `-mesh_straighten` has made to the whole mesh.
struct Straightened {
  PetscInt folded = 0;     ///< cells whose Jacobian was not positive, summed over all rounds
  PetscInt cells = 0;      ///< cells with a node that was moved
  PetscInt nodes = 0;      ///< nodes moved
  PetscInt rounds = 0;     ///< each round straightens the cells that the previous one folded
  double largestMove = 0;  ///< m
};

/// A reference node: a point with a displacement and a rotation, which couplings join to the
/// bodies. It is stored as two nodes that belong to no cell: the components of the first are the
/// displacement, those of the second the rotation. In plane problems the first component of the
/// second node is the rotation about z.
struct Reference {
  std::string name;
  Point position;         ///< m
  PetscInt displacement;  ///< global node whose components are the displacement, m
  PetscInt rotation;      ///< global node whose components are the rotation, rad
  int part;               ///< index into Mesh::partName; each reference node is a part of its own
};

/// The part of the mesh on this rank, with the names and totals of the whole.
struct Mesh {
  MPI_Comm comm = MPI_COMM_NULL;
  int dimension = 3;  ///< 2 for a plane problem in x, y; 3 for a solid
  PetscInt totalNodes = 0, totalCells = 0;
  /// Number of nodes of the file that are in no cell, not counting those that gmsh makes at points
  /// of the geometry.
  PetscInt unusedNodes = 0;
  Straightened straightened;
  double diagonal = 0;      ///< of the box around all nodes of the file, m
  PetscInt ownedNodes = 0;  ///< local nodes 0 … ownedNodes−1 are owned here, the rest are ghosts
  PetscInt firstNode = 0;   ///< global number of local node 0; owned nodes are contiguous
  std::vector<PetscInt> globalNode;  ///< [local node] global number
  std::vector<Point> coordinates;    ///< [local node], m
  /// [local node] gmsh's tag. If a shared node has been split in two, both have its tag. The first
  /// node of a reference has 0, the second −1, and the layer node of a node with tag t has −1 − t.
  std::vector<PetscInt> nodeTag;
  /// [local node] connected part (0 … parts−1) of the bodies; contact does not connect parts
  std::vector<int> nodePart;
  int parts = 0;
  std::vector<std::string> partName;  ///< [part] names of its bodies joined by '+'
  /// Volume groups with a material, or bodies made up of sections.
  std::vector<std::string> bodies;
  std::vector<MaterialGroup> materialGroups;  ///< in the order of the bodies
  std::vector<CellBlock> cells;
  std::vector<std::string> surfaces;  ///< surface groups that options name
  std::vector<FaceBlock> faces;
  /// [group or reference node] owned local nodes, with images replaced by their primaries
  std::map<std::string, std::vector<PetscInt>> nodeGroups;
  /// The same on all ranks. Their global nodes ascend, and the rotation of each follows its
  /// displacement.
  std::vector<Reference> references;
  std::vector<Section> sections;  ///< the same on all ranks
  std::vector<SectionPair> sectionPairs;
  /// All layer nodes that this rank owns, including those of images and those that no interface
  /// uses.
  std::vector<LayerNode> layers;
  PetscInt layerNodes = 0;  ///< on all ranks together
  std::vector<Image> images;
  std::vector<ContactPair> pairs;          ///< of the interfaces that match
  std::vector<InterfaceMatch> interfaces;  ///< in the order of the request

  PetscInt localNodes() const { return globalNode.size(); }
  /// Returns the distance, m, below which a point is treated as coinciding with x. It
  /// exceeds the round-off of coordinates and of their means; the direction of the line
  /// between two closer points is meaningless.
  double coincidence(const Point& x) const;
  /// Returns true if a body is made up of sections.
  bool hasSections() const;
  /// Returns the text that names a material group in messages: "body 'NAME'" or "section 'NAME' of
  /// body 'BODY'".
  std::string materialText(int group) const;
  /// Returns the local number of a global node that this rank owns; −1 for other nodes.
  PetscInt ownedNode(PetscInt global) const {
    const PetscInt local = global - firstNode;
    return local >= 0 && local < ownedNodes ? local : -1;
  }
  /// Returns the number of nodes in cells, over all ranks.
  PetscInt cellNodes() const { return totalNodes - 2 * std::ssize(references) - layerNodes; }
  /// Returns the reference node that has this global node; null if there is none. Borrowed.
  const Reference* referenceWith(PetscInt global) const;
  /// Returns the reference node of this name; null if there is none. Borrowed.
  const Reference* reference(const std::string& name) const;
  /// Returns true if the components of this global node are a rotation.
  bool isRotation(PetscInt global) const {
    const Reference* found = referenceWith(global);
    return found && found->rotation == global;
  }
};

/// Formats the coordinates of a point for a message.
std::string text(const Point& p);

/// Collective. Returns a text with the checksum of nodes and cells as they are distributed. The
/// input files do not determine these: a geometry may include other files, and gmsh may mesh it
/// differently next time.
std::string checksum(const Mesh& mesh);

/// A GroupRequest names a group of the mesh that a later stage needs. `option` is the option that
/// names it, with its dash, for messages where the group is missing or unsuitable.
struct GroupRequest {
  std::string name, option;
};

/// The surfaces of one interface: two surface groups, or a pad on a rigid obstacle.
struct InterfaceRequest {
  std::string name;
  std::string label;       ///< the kind of interface and its name: unique, for messages
  GroupRequest pad, disc;  ///< an empty name of the disc means a rigid obstacle
  bool discIsSlave =
      false;  ///< the gaps are those of the nodes of the disc, even if the meshes match
  /// If the interface has a compliant layer: the surfaces that may become its slave side, the side
  /// of the gaps. Their nodes get layer nodes.
  std::vector<std::string> layered = {};
};

/// A PeriodicRequest requests a periodic constraint: the group `image` is a translated copy of the
/// group `of`.
struct PeriodicRequest {
  std::string image, of;
  std::string option;  ///< the option that requests it, with its dash, for messages
};

/// A reference node at a position or, without one, at the mean position of the nodes of a group.
struct ReferenceRequest {
  std::string name;
  std::optional<VectorValue> position;  ///< m
  GroupRequest centreOf;
  std::string option;  ///< the option that requests it, with its dash, for messages
};

/// A surface group that lies inside a body and cuts it.
struct SectionRequest {
  std::string name;
  GroupRequest surface;
  /// Points to the upper side; without an axis, either side may be the upper one.
  std::optional<VectorValue> axis;
  std::string axisOption;  ///< with its dash, for messages
};

/// The groups that the later stages need from the mesh.
struct Request {
  std::vector<GroupRequest> bodies;  ///< volume groups with a material, or made up of sections
  /// [body] the volume groups that make up the body; a body that is not here is one group.
  std::map<std::string, std::vector<GroupRequest>> bodySections;
  /// Bodies with a motion. If the two sides of an interface share nodes, these bodies are the disc
  /// side.
  std::vector<std::string> moving;
  /// Groups of any dimension, or reference nodes, whose nodes are constrained or loaded.
  std::vector<GroupRequest> nodeGroups;
  std::vector<ReferenceRequest> references;  ///< sorted by name
  std::vector<SectionRequest> sections;      ///< sorted by name
  /// Surface groups that are loaded. The two sides of an interface need not be listed.
  std::vector<GroupRequest> surfaces;
  std::vector<InterfaceRequest> interfaces;
  std::vector<PeriodicRequest> periodic;
  std::string howToGiveMaterials;  ///< "give -…", for messages on cells without a material
  std::string motionOptions;  ///< "-…", for messages on interfaces on which neither side moves
};

}  // namespace squeal::mesh
