// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "model/mesh/body_sections.hpp"
#include "model/mesh/twins.hpp"

namespace squeal::mesh {
namespace {

/// Throws Error unless the cells are of first or second order; reports and contact support no
/// others.
void requireSupported(const WholeBlock& block, const std::string& body) {
  static const std::set<int> supported = {2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 16, 17, 18, 19};
  if (supported.count(block.type)) return;
  throw Error("option -mesh_file: group '" + body + "' has cells '" + block.typeName +
              "'; supported are tri3, tri6, quad4, quad8, quad9, tet4, tet10, hex8, hex20, hex27, "
              "wedge6, wedge15, wedge18, pyramid5, pyramid13, pyramid14");
}

std::string cellText(const WholeMesh& mesh, const ElementPlace& place) {
  const auto& block = mesh.cells[place.block];
  return std::to_string(block.tag[place.element]) + " of group '" +
         mesh.materialGroups[block.material[place.element]].name + "'";
}

/// Throws Error if a cell is there twice, since its stiffness and mass would be doubled, or if it
/// has a node twice.
void requireDistinctCells(const WholeMesh& mesh) {
  if (const auto place = findRepeatedNode(mesh.cells))
    throw Error("option -mesh_file: cell " + cellText(mesh, *place) +
                " has a node twice; write it as the cell with fewer nodes that it is");
  if (const auto twins = findTwins(mesh.cells))
    throw Error("option -mesh_file: the cells " + cellText(mesh, twins->first) + " and " +
                cellText(mesh, twins->second) + " have the same nodes: one cell, written twice");
}

/// Throws Error unless every cell of the largest dimension belongs to a body. A file of version 2
/// repeats a cell for each further group that it is in.
void requireMaterials(const WholeMesh& mesh, const GmshModel& model,
                      const std::map<PetscInt, int>& bodyOf, const Request& request,
                      const NodeIndex& index) {
  if (model.largestDimension() != mesh.dimension) return;
  std::map<PetscInt, std::vector<std::string>> without;  // cell -> its groups
  for (PetscInt tag : model.ungrouped()) without[tag];
  std::set<std::vector<PetscInt>> known;  // made when a cell is first looked for
  const auto isOfABody = [&](std::span<const PetscInt> cell) {
    if (known.empty())
      for (const auto& block : mesh.cells)
        for (std::size_t e = 0; e < block.tag.size(); ++e) known.insert(sorted(block.nodesOf(e)));
    std::vector<PetscInt> nodes(cell.begin(), cell.end());
    return index.translate(nodes) && known.count(sorted(nodes)) > 0;
  };
  for (const auto& [name, group] : model.groups()) {
    if (group.dimension != mesh.dimension) continue;
    for (const auto& block : group.blocks)
      for (std::size_t e = 0; e < block.tag.size(); ++e)
        if (!bodyOf.count(block.tag[e]) && !isOfABody(block.nodesOf(e)))
          without[block.tag[e]].push_back(name);
  }
  if (without.empty()) return;
  const auto& [tag, groups] = *without.begin();
  if (groups.empty())
    throw Error("cell " + std::to_string(tag) + " is in no physical group, so it has no material");
  throw Error("group '" + joined(groups) + "' has no material: " + request.howToGiveMaterials +
              " (cell " + std::to_string(tag) + ")");
}

}  // namespace

void readBodies(WholeMesh& mesh, const GmshModel& model, const Request& request, NodeIndex& index) {
  for (const auto& body : request.bodies) mesh.bodies.push_back(body.name);
  std::map<PetscInt, int> bodyOf;
  for (int b = 0; b < std::ssize(mesh.bodies); ++b) {
    const std::string option = "option " + request.bodies[b].option;
    auto group = model.group(mesh.bodies[b], option);
    if (b == 0) mesh.dimension = group.dimension;
    if (group.dimension != mesh.dimension || group.dimension < 2)
      throw Error(option + ": group '" + mesh.bodies[b] + "' has dimension " +
                  std::to_string(group.dimension) +
                  "; bodies are all volumes, or all surfaces of a plane mesh");
    for (auto& block : group.blocks) {
      requireSupported(block, mesh.bodies[b]);
      index.add(block.nodes);
      auto known = std::find_if(mesh.cells.begin(), mesh.cells.end(),
                                [&](const auto& c) { return c.type == block.type; });
      if (known == mesh.cells.end())
        known = mesh.cells.insert(
            known, WholeBlock{block.type, block.nodesPerElement, block.corners, {}, {}, {}, {}});
      for (auto tag : block.tag) {
        const auto [entry, isNew] = bodyOf.emplace(tag, b);
        if (!isNew && entry->second == b) rejectTwoSections(mesh, model, request, b, tag);
        if (!isNew && entry->second == b)
          throw Error("option -mesh_file: two cells of group '" + mesh.bodies[b] +
                      "' have the tag " + std::to_string(tag));
        if (!isNew)
          throw Error("cell " + std::to_string(tag) + " is in the groups '" +
                      mesh.bodies[entry->second] + "' and '" + mesh.bodies[b] +
                      "', which both have a material; a cell has one");
      }
      known->nodes.insert(known->nodes.end(), block.nodes.begin(), block.nodes.end());
      known->tag.insert(known->tag.end(), block.tag.begin(), block.tag.end());
      known->label.insert(known->label.end(), block.tag.size(), b);
    }
  }
  assignMaterials(mesh, model, request, index);
  requireMaterials(mesh, model, bodyOf, request, index);
  requireDistinctCells(mesh);
  if (mesh.dimension == 2)
    for (const auto& point : mesh.points)
      if (std::abs(point[2] - mesh.points[0][2]) > 0)
        throw Error("option -mesh_file: a plane mesh must lie in a plane z = constant");
}

}  // namespace squeal::mesh
