// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/sections.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "base/system/error.hpp"
#include "base/system/text.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::mesh {
namespace {

/// Returns the normal of a face, or of a line in the plane, with the length of its area.
Point areaVector(const WholeMesh& mesh, std::span<const PetscInt> corners) {
  const Point a = mesh.points[corners[0]], ab = minus(mesh.points[corners[1]], a);
  if (mesh.dimension == 2) return {ab[1], -ab[0], 0};
  Point sum{};
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum = plus(sum, cross(minus(mesh.points[corners[i - 1]], a), minus(mesh.points[corners[i]], a)),
               0.5);
  return sum;
}

/// Returns the uses of groups by options that need their nodes or faces, not only their centre.
std::vector<GroupRequest> usesOf(const Request& request) {
  std::vector<GroupRequest> uses = request.nodeGroups;
  uses.insert(uses.end(), request.surfaces.begin(), request.surfaces.end());
  for (const auto& interface : request.interfaces)
    uses.insert(uses.end(), {interface.pad, interface.disc});
  for (const auto& [image, of, option] : request.periodic)
    uses.insert(uses.end(), {{image, option}, {of, option}});
  return uses;
}

/// Throws Error for two bolts with the same section.
void requireOwnGroup(const SectionRequest& section, const Request& request) {
  for (const auto& other : request.sections)
    if (other.name < section.name && other.surface.name == section.surface.name)
      throw Error("option " + section.surface.option + ": the bolt '" + other.name +
                  "' has this section already; each bolt needs a section of its own");
}

/// Cuts one section.
class Cut {
 public:
  Cut(WholeMesh& mesh, const SectionRequest& request, const meshfile::GroupElements& group)
      : mesh_(mesh),
        request_(request),
        group_(group),
        head_("option " + request.surface.option + ": ") {
    for (const auto& block : group.blocks) nodes_.insert(block.nodes.begin(), block.nodes.end());
    if (nodes_.empty()) throw Error(head_ + "group '" + request.surface.name + "' has no faces");
    setNormal();
  }
  /// Doubles the nodes, for the cells on the upper side.
  void doubleNodes();
  /// Throws Error if a bolt, [node], has a node of this section already.
  void requireOwnNodes(const std::map<PetscInt, std::string>& boltOf) const;
  /// Throws Error if the group of this use is the section, or has a face of it.
  void rejectUse(const GroupRequest& use, const meshfile::GroupElements& group) const;
  /// Gives the elements of a group on the upper side their nodes.
  void take(meshfile::GroupElements& group) const;
  const Point& normal() const { return normal_; }
  /// Returns the new node of each node.
  const std::map<PetscInt, PetscInt>& upper() const { return upper_; }

 private:
  void setNormal();
  double height(std::span<const PetscInt> corners) const;
  void requireFullCut(const std::vector<std::set<PetscInt>>& others) const;

  WholeMesh& mesh_;
  const SectionRequest& request_;
  const meshfile::GroupElements& group_;
  std::string head_;
  std::set<PetscInt> nodes_;
  Point normal_{};
  std::map<PetscInt, PetscInt> upper_;
};

void Cut::setNormal() {
  std::vector<Point> vectors;
  for (const auto& block : group_.blocks)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      vectors.push_back(areaVector(mesh_, block.cornersOf(e)));
  const Point first = vectors.front(),
              along = request_.axis ? request_.axis->in(mesh_.dimension) : first;
  if (length(along) == 0) throw Error("option " + request_.axisOption + ": must not be zero");
  for (Point& vector : vectors) {
    if (dot(vector, first) < 0) vector = scaled(vector, -1);
    normal_ = plus(normal_, vector);
  }
  normal_ = unit(normal_);
  constexpr double across = 0.1;  // cosine of 84 degrees
  const double sense = dot(unit(along), normal_);
  if (std::abs(sense) < across)
    throw Error("option " + request_.axisOption +
                ": the axis lies across the normal of the section, " + text(normal_) +
                ", and so does not select its upper side");
  if (sense < 0) {
    normal_ = scaled(normal_, -1);
    for (Point& vector : vectors) vector = scaled(vector, -1);
  }
  for (const Point& vector : vectors)
    if (dot(unit(vector), normal_) < 0.9)
      throw Error(head_ +
                  "the section must be flat; a face of it is inclined by more than 25 "
                  "degrees to the others");
}

/// Returns the distance of the centre of an element above a node of the section that it has.
double Cut::height(std::span<const PetscInt> corners) const {
  for (const PetscInt node : corners)
    if (nodes_.contains(node))
      return dot(minus(centroid(mesh_, corners), mesh_.points[node]), normal_);
  return 0;
}

/// Throws Error if cells on both sides share a node that is not in the section.
void Cut::requireFullCut(const std::vector<std::set<PetscInt>>& others) const {
  for (const PetscInt node : others[0])
    if (others[1].contains(node))
      throw Error(head_ +
                  "the section does not cut through its body: cells on both sides of it "
                  "share the node at " +
                  text(mesh_.points[node]) + "; extend it to the surface of the body");
}

void Cut::doubleNodes() {
  std::map<PetscInt, std::vector<int>> facesAt;  // [node]
  std::vector<int> corners;
  for (const auto& block : group_.blocks)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      for (const PetscInt node : block.cornersOf(e)) facesAt[node].push_back(std::ssize(corners));
      corners.push_back(block.corners);
    }
  std::vector<std::array<int, 2>> cellsOf(corners.size());  // [face][side]
  std::vector<std::set<PetscInt>> others(2);                // [side] nodes outside the section
  std::vector<std::span<PetscInt>> upperCells;
  int body = -1;
  for (auto& block : mesh_.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      const auto cell = std::as_const(block).cornersOf(e);
      if (std::ranges::none_of(cell, [&](PetscInt node) { return nodes_.contains(node); }))
        continue;
      if (body >= 0 && block.label[e] != body)
        throw Error(head_ + "nodes of the section belong to the bodies '" + mesh_.bodies[body] +
                    "' and '" + mesh_.bodies[block.label[e]] +
                    "'; a section must lie inside one body, which shares no node with others "
                    "there");
      body = block.label[e];
      const int side = height(cell) > 0;
      if (side == 1) upperCells.push_back(block.nodesOf(e));
      std::map<int, int> shared;
      for (const PetscInt node : cell) {
        if (const auto faces = facesAt.find(node); faces != facesAt.end())
          for (const int face : faces->second) ++shared[face];
        if (!nodes_.contains(node)) others[side].insert(node);
      }
      for (const auto& [face, count] : shared)
        if (count == corners[face]) ++cellsOf[face][side];
    }
  for (const auto& count : cellsOf)
    if (count[0] != 1 || count[1] != 1)
      throw Error(head_ + formatted("a face of the section has %d cells of a body below and %d "
                                    "above; a section cuts a body, so each face needs one of each",
                                    count[0], count[1]));
  requireFullCut(others);
  for (const PetscInt node : nodes_) {
    upper_[node] = mesh_.nodeCount();
    mesh_.points.push_back(Point(mesh_.points[node]));
    mesh_.tags.push_back(PetscInt(mesh_.tags[node]));
  }
  for (const auto cell : upperCells)
    for (PetscInt& node : cell)
      if (const auto found = upper_.find(node); found != upper_.end()) node = found->second;
}

void Cut::requireOwnNodes(const std::map<PetscInt, std::string>& boltOf) const {
  for (const PetscInt node : nodes_)
    if (const auto found = boltOf.find(node); found != boltOf.end())
      throw Error(head_ + "the node at " + text(mesh_.points[node]) +
                  " belongs to the section of the bolt '" + found->second +
                  "' already; sections must not share nodes");
}

void Cut::rejectUse(const GroupRequest& use, const meshfile::GroupElements& group) const {
  if (group.dimension != mesh_.dimension - 1) return;
  for (const auto& block : group.blocks)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      const auto corners = block.cornersOf(e);
      if (!std::ranges::all_of(corners, [&](PetscInt node) { return nodes_.contains(node); }))
        continue;
      const bool isSame = use.name == request_.surface.name;
      throw Error(
          "option " + use.option + ": group '" + use.name +
          (isSame ? "' is the section" : "' has a face of the section") + " of the bolt '" +
          request_.name + "' (" + request_.surface.option +
          "), whose nodes are doubled, so that it would mean one of the two sides; only the "
          "bolt may use these faces: use another group");
    }
}

void Cut::take(meshfile::GroupElements& group) const {
  for (auto& block : group.blocks)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      const auto corners = std::as_const(block).cornersOf(e);
      double size = 0;
      for (const PetscInt node : corners)
        size = std::max(size, length(minus(mesh_.points[node], mesh_.points[corners[0]])));
      if (height(corners) <= 1e-9 * size) continue;
      for (PetscInt& node : block.nodesOf(e))
        if (const auto found = upper_.find(node); found != upper_.end()) node = found->second;
    }
}

}  // namespace

void cutSections(WholeMesh& mesh, std::map<std::string, meshfile::GroupElements>& groups,
                 const Request& request) {
  std::map<PetscInt, std::string> boltOf;  // [node]
  const auto uses = usesOf(request);
  for (const auto& wanted : request.sections) {
    requireOwnGroup(wanted, request);
    Cut section(mesh, wanted, groups.at(wanted.surface.name));
    section.requireOwnNodes(boltOf);
    section.doubleNodes();
    for (const auto& use : uses)
      if (const auto used = groups.find(use.name); used != groups.end())
        section.rejectUse(use, used->second);
    for (auto& [name, group] : groups)
      if (name != wanted.surface.name) section.take(group);
    for (const auto& [lower, upper] : section.upper()) {
      boltOf[lower] = boltOf[upper] = wanted.name;
      mesh.sectionPairs.push_back({upper, lower, int(std::ssize(mesh.sections)), -1});
    }
    mesh.sections.push_back({wanted.name, section.normal(), -1});
  }
}

}  // namespace squeal::mesh
