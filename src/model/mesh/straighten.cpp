// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/straighten.hpp"

#include <algorithm>

#include "model/mesh/vector.hpp"

namespace squeal::mesh {
namespace {

/// The nodes that keep their places relative to each other: images, primaries and partners in
/// contact.
class Bundles {
 public:
  explicit Bundles(const WholeMesh& mesh) : next_(mesh.points.size()) {
    for (PetscInt node = 0; node < mesh.nodeCount(); ++node) next_[node] = node;
    for (const auto& image : mesh.images) join(image.node, image.primary);
    for (const auto& pair : mesh.pairs)
      if (pair.master >= 0) join(pair.node, pair.master);
  }
  /// Calls `visit` for the node and for all that are bound to it.
  template <class Visit>
  void forEach(PetscInt node, Visit visit) const {
    PetscInt member = node;
    do visit(member);
    while ((member = next_[member]) != node);
  }

 private:
  /// Joins two rings into one; a ring is left as it is if it holds both nodes.
  void join(PetscInt a, PetscInt b) {
    bool together = false;
    forEach(a, [&](PetscInt member) { together = together || member == b; });
    if (!together) std::swap(next_[a], next_[b]);
  }
  std::vector<PetscInt> next_;  // [node] the next one of its ring
};

class Straightener {
 public:
  Straightener(WholeMesh& mesh, const CellGeometry& geometry)
      : mesh_(mesh),
        geometry_(geometry),
        bundles_(mesh),
        fixed_(mesh.points.size(), 0),
        moved_(mesh.points.size(), 0),
        touched_(mesh.points.size(), 1) {
    for (const auto& block : mesh.cells)
      for (std::size_t e = 0; e < block.tag.size(); ++e)
        for (PetscInt corner : block.cornersOf(e))
          bundles_.forEach(corner, [&](PetscInt node) { fixed_[node] = 1; });
  }

  /// Straightens the cells that are folded, or all, and those that have a moved node and are folded
  /// then, until none is.
  void run(bool all) {
    std::vector<std::vector<char>> straight;
    for (const auto& block : mesh_.cells) straight.emplace_back(block.tag.size(), 0);
    for (bool again = true; again;) {
      std::vector<std::pair<std::size_t, std::size_t>> cells;  // (block, element)
      for (std::size_t b = 0; b < mesh_.cells.size(); ++b)
        for (std::size_t e = 0; e < mesh_.cells[b].tag.size(); ++e) {
          if (straight[b][e] || !isCurvedAndTouched(mesh_.cells[b], e)) continue;
          const bool folded = geometry_.isFolded(mesh_.cells[b].type, places(mesh_.cells[b], e));
          mesh_.straightened.folded += folded;
          if (folded || all) cells.emplace_back(b, e);
        }
      std::fill(touched_.begin(), touched_.end(), 0);
      for (const auto& [b, e] : cells) straightenCell(mesh_.cells[b], e), straight[b][e] = 1;
      again = std::any_of(touched_.begin(), touched_.end(), [](char touched) { return touched; });
      mesh_.straightened.rounds += again;
    }
    count();
  }

 private:
  std::vector<Point> places(const WholeBlock& block, std::size_t e) const {
    std::vector<Point> points;
    for (PetscInt node : block.nodesOf(e)) points.push_back(mesh_.points[node]);
    return points;
  }
  /// Returns true if the cell has nodes other than corners, and one that the last round has moved.
  bool isCurvedAndTouched(const WholeBlock& block, std::size_t e) const {
    const auto nodes = block.nodesOf(e).subspan(block.corners);
    return std::any_of(nodes.begin(), nodes.end(), [&](PetscInt node) { return touched_[node]; });
  }
  void straightenCell(const WholeBlock& block, std::size_t e) {
    const auto nodes = block.nodesOf(e);
    const auto points = places(block, e);
    const auto straight = geometry_.straightened(block.type, points);
    double size = 0;
    for (int c = 1; c < block.corners; ++c)
      size = std::max(size, length(minus(points[c], points[0])));
    for (std::size_t i = block.corners; i < nodes.size(); ++i) {
      const Point shift = minus(straight[i], points[i]);
      // An edge that is straight to the digits of a mesh file stays as it is.
      if (fixed_[nodes[i]] || length(shift) <= 1e-6 * size) continue;
      mesh_.straightened.largestMove = std::max(mesh_.straightened.largestMove, length(shift));
      bundles_.forEach(nodes[i], [&](PetscInt node) {
        for (std::size_t d = 0; d < 3; ++d) mesh_.points[node][d] += shift[d];
        moved_[node] = touched_[node] = 1;
      });
    }
  }
  void count() {
    mesh_.straightened.nodes = std::count(moved_.begin(), moved_.end(), 1);
    for (const auto& block : mesh_.cells)
      for (std::size_t e = 0; e < block.tag.size(); ++e) {
        const auto nodes = block.nodesOf(e);
        mesh_.straightened.cells +=
            std::any_of(nodes.begin(), nodes.end(), [&](PetscInt node) { return moved_[node]; });
      }
  }

  WholeMesh& mesh_;
  const CellGeometry& geometry_;
  Bundles bundles_;
  std::vector<char> fixed_;    // [node] 1: a corner, or bound to one
  std::vector<char> moved_;    // [node]
  std::vector<char> touched_;  // [node] moved in the last round; at first all
};

}  // namespace

void straighten(WholeMesh& mesh, const CellGeometry& geometry, Straightening which) {
  if (which != Straightening::none) Straightener(mesh, geometry).run(which == Straightening::all);
}

}  // namespace squeal::mesh
