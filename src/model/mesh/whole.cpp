// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/whole.hpp"

#include <algorithm>
#include <set>

#include "base/petsc/check.hpp"
#include "base/system/disjoint_sets.hpp"
#include "base/system/text.hpp"
#include "model/element/shape.hpp"
#include "model/mesh/bodies.hpp"
#include "model/mesh/references.hpp"
#include "model/mesh/sections.hpp"
#include "model/mesh/twins.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::mesh {
namespace {

/// The cells at each node of interest, and the cells that hold all corners of an element.
class Adjacency {
 public:
  Adjacency(const WholeMesh& mesh, const std::set<PetscInt>& nodesOfInterest) : mesh_(mesh) {
    PetscInt cell = 0;
    for (const auto& block : mesh.cells)
      for (std::size_t e = 0; e < block.tag.size(); ++e, ++cell)
        for (PetscInt node : block.nodesOf(e))
          if (nodesOfInterest.count(node)) cells_[node].push_back(cell);
  }
  std::vector<PetscInt> cellsHolding(std::span<const PetscInt> corners) const {
    std::vector<PetscInt> common = cells_.at(corners[0]);
    for (PetscInt corner : corners.subspan(1)) {
      std::vector<PetscInt> both;
      const auto& next = cells_.at(corner);
      std::set_intersection(common.begin(), common.end(), next.begin(), next.end(),
                            std::back_inserter(both));
      common = both;
    }
    return common;
  }

 private:
  const WholeMesh& mesh_;
  std::map<PetscInt, std::vector<PetscInt>> cells_;
};

struct CellReference {
  WholeBlock* block;
  std::size_t element;
  std::span<PetscInt> nodes() const { return block->nodesOf(element); }
  std::span<const PetscInt> corners() const { return block->cornersOf(element); }
  int label() const { return block->label[element]; }
};

std::vector<CellReference> references(WholeMesh& mesh) {
  std::vector<CellReference> all;
  for (auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) all.push_back({&block, e});
  return all;
}

/// All named groups that are not bodies, read once before nodes are split.
struct NamedElements {
  std::map<std::string, meshfile::GroupElements> groups;
  std::set<PetscInt> nodes() const {
    std::set<PetscInt> all;
    for (const auto& [name, group] : groups)
      for (const auto& block : group.blocks) all.insert(block.nodes.begin(), block.nodes.end());
    return all;
  }
};

NamedElements readNamed(const WholeMesh& mesh, const GmshModel& model, const Request& request,
                        const NodeIndex& index) {
  NamedElements named;
  const auto add = [&](const GroupRequest& request, int dimension,
                       const std::vector<std::string>& references = {}) {
    const std::string& name = request.name;
    const std::string wantedBy = "option " + request.option;
    if (named.groups.count(name)) return;
    auto group = model.group(name, wantedBy, references);
    if (dimension >= 0 && group.dimension != dimension)
      throw Error(wantedBy + ": group '" + name + "' has dimension " +
                  std::to_string(group.dimension) + "; a boundary of dimension " +
                  std::to_string(dimension) + " is wanted");
    for (auto& block : group.blocks)
      if (!index.translate(block.nodes))
        throw Error(wantedBy + ": group '" + name + "' has nodes that belong to no body");
    named.groups[name] = group;
  };
  const int boundary = mesh.dimension - 1;
  for (const auto& interface : request.interfaces) {
    add(interface.pad, boundary);
    if (!interface.disc.name.empty()) add(interface.disc, boundary);
  }
  for (const auto& surface : request.surfaces) add(surface, boundary);
  for (const auto& reference : request.references)
    if (!reference.position) add(reference.centreOf, -1);
  for (const auto& section : request.sections) add(section.surface, boundary);
  std::vector<std::string> references;
  for (const auto& reference : request.references) references.push_back(reference.name);
  for (const auto& group : request.nodeGroups)
    if (std::ranges::find(references, group.name) == references.end()) add(group, -1, references);
  for (const auto& pair : request.periodic) {
    add({pair.image, pair.option}, -1);
    add({pair.of, pair.option}, -1);
  }
  return named;
}

/// The two sides of a contact interface whose nodes both bodies share.
enum class ContactSide { resting, moving };

class Splitter {
 public:
  Splitter(WholeMesh& mesh, const Request& request, const NamedElements& named)
      : mesh_(mesh), request_(request), adjacency_(mesh, named.nodes()), cells_(references(mesh)) {
    for (const auto& body : mesh.bodies)
      moves_.push_back(std::find(request.moving.begin(), request.moving.end(), body) !=
                       request.moving.end());
  }
  ContactSide side(PetscInt cell) const {
    return moves_[cells_[cell].label()] ? ContactSide::moving : ContactSide::resting;
  }
  std::string bodyName(PetscInt cell) const { return mesh_.bodies[cells_[cell].label()]; }
  const Adjacency& adjacency() const { return adjacency_; }
  CellReference cell(PetscInt number) const { return cells_[number]; }

  /// Doubles each node on contact faces that lie between a moving and a resting cell; the resting
  /// cells take the new nodes.
  void split(const NamedElements& named) {
    for (const auto& interface : request_.interfaces)
      for (const auto& block : named.groups.at(interface.pad.name).blocks)
        for (std::size_t e = 0; e < block.tag.size(); ++e) {
          const auto neighbours = adjacency_.cellsHolding(block.cornersOf(e));
          if (neighbours.size() < 2) continue;
          if (bodyName(neighbours[0]) == bodyName(neighbours[1]))
            throw Error("option " + interface.pad.option + ": '" + interface.pad.name +
                        "' lies inside the body '" + bodyName(neighbours[0]) +
                        "', whose cells are on both sides of it; contact is between two bodies, "
                        "groups with a material each");
          if (side(neighbours[0]) == side(neighbours[1]))
            throw Error("option " + interface.pad.option + ": the bodies '" +
                        bodyName(neighbours[0]) + "' and '" + bodyName(neighbours[1]) +
                        "' share the nodes of '" + interface.pad.name +
                        "'; to tell disc from pad, exactly one of them must have a " +
                        request_.motionOptions + " option");
          for (PetscInt node : block.nodesOf(e)) restingTwin_.emplace(node, -1);
        }
    for (auto& [node, twin] : restingTwin_) {
      twin = mesh_.nodeCount();
      mesh_.points.push_back(mesh_.points[node]);
      mesh_.tags.push_back(mesh_.tags[node]);
    }
    if (restingTwin_.empty()) return;
    for (PetscInt c = 0; c < std::ssize(cells_); ++c)
      if (side(c) == ContactSide::resting)
        for (PetscInt& node : cells_[c].nodes()) node = twin(node, ContactSide::resting);
  }
  /// Returns true if each of these nodes has been doubled.
  bool isSplit(std::span<const PetscInt> nodes) const {
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](PetscInt node) { return restingTwin_.count(node) > 0; });
  }
  PetscInt twin(PetscInt node, ContactSide side) const {
    if (side == ContactSide::moving) return node;
    const auto found = restingTwin_.find(node);
    return found == restingTwin_.end() ? node : found->second;
  }

 private:
  WholeMesh& mesh_;
  const Request& request_;
  Adjacency adjacency_;  // of the nodes before the split
  std::vector<CellReference> cells_;
  std::vector<bool> moves_;
  std::map<PetscInt, PetscInt> restingTwin_;
};

/// Returns the nodes of a group after the split. An element that bounds cells of both sides gives
/// the nodes of both.
std::vector<PetscInt> groupNodes(const meshfile::GroupElements& group, const Splitter& splitter) {
  std::set<PetscInt> nodes;
  for (const auto& block : group.blocks)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      for (PetscInt cell : splitter.adjacency().cellsHolding(block.cornersOf(e)))
        for (PetscInt node : block.nodesOf(e))
          nodes.insert(splitter.twin(node, splitter.side(cell)));
  return {nodes.begin(), nodes.end()};
}

/// Fills WholeMesh::discFaces: the faces of the disc sides by their nodes after the split, once for
/// each cell that they bound.
void readDiscFaces(WholeMesh& mesh, const Request& request, const NamedElements& named,
                   const Splitter& splitter) {
  for (const auto& interface : request.interfaces) {
    if (interface.disc.name.empty()) continue;
    auto& faces = mesh.discFaces[interface.disc.name];
    for (const auto& block : named.groups.at(interface.disc.name).blocks)
      for (std::size_t e = 0; e < block.tag.size(); ++e)
        for (PetscInt cell : splitter.adjacency().cellsHolding(block.cornersOf(e))) {
          faces.emplace_back();
          for (PetscInt node : block.nodesOf(e))
            faces.back().push_back(splitter.twin(node, splitter.side(cell)));
        }
  }
}

/// Returns +1 if the normal of the face by the order of its corners points away from `inside`,
/// otherwise −1.
int outwardSign(const WholeMesh& mesh, std::span<const PetscInt> corners, const Point& inside) {
  const auto at = [&](int i) { return mesh.points[corners[i]]; };
  const Point a = at(0), b = at(1), c = mesh.dimension == 3 ? at(2) : a;
  const Point e = minus(b, a);
  const Point normal = mesh.dimension == 3 ? cross(e, minus(c, a)) : Point{e[1], -e[0], 0};
  return dot(normal, minus(centroid(mesh, corners), inside)) > 0 ? 1 : -1;
}

/// Throws Error if a face is there twice, since its pressure and contact area would be doubled.
void requireDistinctFaces(const std::string& surface, const meshfile::GroupElements& group) {
  const auto tag = [&](const ElementPlace& place) {
    return std::to_string(group.blocks[place.block].tag[place.element]);
  };
  if (const auto place = findRepeatedNode(group.blocks))
    throw Error("option -mesh_file: face " + tag(*place) + " of group '" + surface +
                "' has a node twice");
  if (const auto twins = findTwins(group.blocks))
    throw Error("option -mesh_file: the faces " + tag(twins->first) + " and " + tag(twins->second) +
                " of group '" + surface + "' have the same nodes: one face, written twice");
}

/// What a surface group is asked for; it may be all three.
struct SurfaceUse {
  bool loaded = false, pad = false, disc = false;
};

std::map<std::string, SurfaceUse> usesOf(const Request& request) {
  std::map<std::string, SurfaceUse> uses;
  for (const auto& surface : request.surfaces) uses[surface.name].loaded = true;
  for (const auto& interface : request.interfaces) {
    uses[interface.pad.name].pad = true;
    if (!interface.disc.name.empty()) uses[interface.disc.name].disc = true;
  }
  return uses;
}

/// Returns the cell that a face bounds; −1 for a face of the disc's group inside the disc or where
/// the bodies stay joined, which cannot touch a pad. Where pad and disc share the face, the group
/// of the pad means the face of the resting cell, and that of the disc alone means the face of the
/// moving one. Throws Error if the cell is not unique.
PetscInt boundedCell(const Splitter& splitter, const SurfaceUse& use, const std::string& surface,
                     const WholeBlock& block, std::size_t face) {
  const auto cells = splitter.adjacency().cellsHolding(block.cornersOf(face));
  if (cells.size() == 2) {
    const bool firstRests = splitter.side(cells[0]) == ContactSide::resting;
    if (use.pad) return cells[firstRests ? 0 : 1];
    if (use.disc && !use.loaded) {
      const bool opens = splitter.side(cells[0]) != splitter.side(cells[1]) &&
                         splitter.isSplit(block.nodesOf(face));
      return opens ? cells[firstRests ? 1 : 0] : -1;
    }
  }
  if (cells.size() != 1)
    throw Error("surface group '" + surface + "': face " + std::to_string(block.tag[face]) +
                " must bound one cell of a body, it bounds " + std::to_string(cells.size()));
  return cells[0];
}

/// Throws Error unless the faces are of first or second order, as the cells are.
void requireSupported(const WholeBlock& block, const std::string& surface) {
  if (element::isKnown(block.type)) return;
  throw Error("option -mesh_file: group '" + surface + "' has faces '" + block.typeName +
              "'; supported are line2, line3, tri3, tri6, quad4, quad8, quad9");
}

/// Returns the block for faces of this type, with a new one if there is none.
WholeFaces& facesOfType(WholeMesh& mesh, const WholeBlock& like) {
  for (auto& faces : mesh.faces)
    if (faces.type == like.type) return faces;
  auto& faces = mesh.faces.emplace_back();
  faces.type = like.type, faces.nodesPerElement = like.nodesPerElement,
  faces.corners = like.corners;
  return faces;
}

void readFaces(WholeMesh& mesh, const Request& request, const NamedElements& named,
               const Splitter& splitter) {
  for (const auto& [name, use] : usesOf(request)) {
    const int label = std::ssize(mesh.surfaces);
    mesh.surfaces.push_back(name);
    requireDistinctFaces(name, named.groups.at(name));
    for (const auto& block : named.groups.at(name).blocks) {
      requireSupported(block, name);
      auto& faces = facesOfType(mesh, block);
      for (std::size_t e = 0; e < block.tag.size(); ++e) {
        const PetscInt cell = boundedCell(splitter, use, name, block, e);
        if (cell < 0) continue;
        for (PetscInt node : block.nodesOf(e))
          faces.nodes.push_back(splitter.twin(node, splitter.side(cell)));
        faces.label.push_back(label);
        faces.tag.push_back(block.tag[e]);
        faces.cell.push_back(cell);
        faces.sign.push_back(
            outwardSign(mesh, block.cornersOf(e), centroid(mesh, splitter.cell(cell).corners())));
      }
    }
  }
}

/// Returns the diagonal of the box around these points.
double diagonalOf(const std::vector<Point>& points) {
  if (points.empty()) return 0;
  Point low = points[0], high = points[0];
  for (const Point& x : points)
    for (std::size_t d = 0; d < 3; ++d)
      low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
  return length(minus(high, low));
}

/// Finds the connected parts of the mesh: the nodes of a cell are connected.
void findParts(WholeMesh& mesh) {
  DisjointSets<PetscInt> parts(mesh.points.size());
  for (auto cell : references(mesh))
    for (PetscInt node : cell.nodes().subspan(1)) parts.join(cell.nodes()[0], node);
  for (const auto& reference : mesh.references)
    parts.join(reference.displacement, reference.rotation);
  std::map<PetscInt, int> number;
  mesh.part.resize(mesh.points.size());
  for (PetscInt node = 0; node < mesh.nodeCount(); ++node)
    mesh.part[node] = number.emplace(parts.smallest(node), number.size()).first->second;
  std::vector<std::set<std::string>> names(number.size());
  for (auto cell : references(mesh))
    names[mesh.part[cell.nodes()[0]]].insert(mesh.bodies[cell.label()]);
  for (auto& reference : mesh.references) {
    reference.part = mesh.part[reference.displacement];
    names[reference.part] = {"reference node " + reference.name};
  }
  for (auto& pair : mesh.sectionPairs) pair.lowerPart = mesh.part[pair.lower];
  for (const auto& set : names) mesh.partName.push_back(joined({set.begin(), set.end()}, "+"));
}

}  // namespace

Point centroid(const WholeMesh& mesh, std::span<const PetscInt> nodes) {
  Point centre{};
  for (PetscInt node : nodes)
    for (std::size_t d = 0; d < 3; ++d) centre[d] += mesh.points[node][d] / nodes.size();
  return centre;
}

PetscInt WholeMesh::cellCount() const {
  PetscInt count = 0;
  for (const auto& block : cells) count += block.tag.size();
  return count;
}

WholeMesh load(const meshfile::Settings& file, const Request& request, meshfile::Reader reader) {
  GmshModel model(file, reader);
  model.joinSections(request);
  WholeMesh mesh;
  NodeIndex index(mesh, model);
  readBodies(mesh, model, request, index);
  mesh.unusedNodes = index.countUnused();
  NamedElements named = readNamed(mesh, model, request, index);
  cutSections(mesh, named.groups, request);
  Splitter splitter(mesh, request, named);
  splitter.split(named);
  readFaces(mesh, request, named, splitter);
  readDiscFaces(mesh, request, named, splitter);
  for (const auto& [name, group] : named.groups)
    mesh.nodeGroups[name] = groupNodes(group, splitter);
  mesh.diagonal = diagonalOf(mesh.points);
  addReferences(mesh, model, request);
  findParts(mesh);
  return mesh;
}

}  // namespace squeal::mesh
