// SPDX-License-Identifier: BSD-2-Clause
#include "model/mortar/face.hpp"

#include <algorithm>
#include <unordered_map>

#include "base/petsc/check.hpp"
#include "model/element/shape.hpp"

namespace squeal::mortar {
namespace {

/// Finds the cell of this rank that a face bounds. One pass over the cells lists the cells at the
/// first node of each face; a face is then compared with these few cells.
class CellFinder {
 public:
  CellFinder(const mesh::Mesh& mesh, int surface) {
    for (const auto& block : mesh.faces)
      for (std::size_t e = 0; e < block.surface.size(); ++e)
        if (block.surface[e] == surface) cells_[block.nodesOf(e)[0]];
    if (cells_.empty()) return;
    for (const auto& block : mesh.cells)
      for (std::size_t e = 0; e < block.body.size(); ++e)
        for (PetscInt node : block.nodesOf(e))
          if (const auto found = cells_.find(node); found != cells_.end())
            found->second.push_back({block.nodesOf(e), block.body[e], block.material[e]});
  }
  struct Cell {
    std::span<const PetscInt> nodes;
    int body, material;
  };
  /// Returns the cell that has all of these nodes.
  const Cell& cellAt(std::span<const PetscInt> nodes) const {
    for (const auto& cell : cells_.at(nodes[0]))
      if (std::all_of(nodes.begin(), nodes.end(), [&](PetscInt node) {
            return std::find(cell.nodes.begin(), cell.nodes.end(), node) != cell.nodes.end();
          }))
        return cell;
    throw Error("a face of the mesh bounds no cell of its process");
  }

 private:
  std::unordered_map<PetscInt, std::vector<Cell>> cells_;  // [first local node of a face]
};

}  // namespace

void fields(Stream& stream, Face& face) {
  auto& [type, nodes, parts, points, sign, body, material] = face;
  stream(type, nodes, parts, points, sign, body, material);
}

std::vector<Face> facesOf(const mesh::Mesh& mesh, const std::string& surface) {
  const auto named = std::find(mesh.surfaces.begin(), mesh.surfaces.end(), surface);
  if (named == mesh.surfaces.end()) throw Error("no option names the surface '" + surface + "'");
  const int label = named - mesh.surfaces.begin();
  const CellFinder finder(mesh, label);
  std::vector<Face> faces;
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      if (block.surface[e] != label) continue;
      const auto nodes = block.nodesOf(e);
      const std::size_t corners = element::shapeTable(block.type).corners;
      Face& face = faces.emplace_back();
      face.type = block.type;
      face.sign = block.sign[e];
      const auto& cell = finder.cellAt(nodes.first(corners));
      face.body = cell.body, face.material = cell.material;
      for (PetscInt node : nodes) {
        face.nodes.push_back(mesh.globalNode[node]);
        face.parts.push_back(mesh.nodePart[node]);
        face.points.push_back(mesh.coordinates[node]);
      }
    }
  return faces;
}

}  // namespace squeal::mortar
