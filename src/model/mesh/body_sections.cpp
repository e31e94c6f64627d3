// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/body_sections.hpp"

#include <algorithm>
#include <unordered_map>

#include "base/system/error.hpp"
#include "base/system/text.hpp"
#include "model/mesh/twins.hpp"

namespace squeal::mesh {
namespace {

using meshfile::GroupElements;

bool hasElement(const GroupElements& group, PetscInt tag) {
  return std::ranges::any_of(group.blocks, [tag](const auto& block) {
    return std::ranges::find(block.tag, tag) != block.tag.end();
  });
}

[[noreturn]] void throwTwoSections(PetscInt tag, const std::string& one, const std::string& other,
                                   const std::string& body) {
  throw Error("cell " + std::to_string(tag) + " is in the sections '" + one + "' and '" + other +
              "' of body '" + body +
              "'; a cell has one material: remove it from one of the groups");
}

/// The cells of one body, found by their tags or nodes.
class BodyCells {
 public:
  BodyCells(WholeMesh& mesh, int body) : mesh_(mesh), body_(body) {
    forEach([&](ElementPlace place, PetscInt tag) { byTag_[tag] = place; });
  }
  /// Returns the cell on the nodes of an element; null if there is none. A file of version 2 gives
  /// a cell another tag for each further group that it is in.
  int* materialOf(const WholeBlock& block, std::size_t e, const NodeIndex& index) {
    std::vector<PetscInt> nodes(block.nodesOf(e).begin(), block.nodesOf(e).end());
    if (!index.translate(nodes)) return nullptr;
    nodes = sorted(nodes);
    if (const auto found = byTag_.find(block.tag[e]);
        found != byTag_.end() && nodesOf(found->second) == nodes)
      return &at(found->second);
    if (byNodes_.empty())
      forEach([&](ElementPlace place, PetscInt) { byNodes_[nodesOf(place)] = place; });
    const auto found = byNodes_.find(nodes);
    return found == byNodes_.end() ? nullptr : &at(found->second);
  }
  /// Returns the smallest tag of a cell without material; −1 if all have one.
  PetscInt firstWithout() const {
    PetscInt first = -1;
    forEach([&](ElementPlace place, PetscInt tag) {
      if (mesh_.cells[place.block].material[place.element] < 0 && (first < 0 || tag < first))
        first = tag;
    });
    return first;
  }

 private:
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (std::size_t b = 0; b < mesh_.cells.size(); ++b)
      for (std::size_t e = 0; e < mesh_.cells[b].tag.size(); ++e)
        if (mesh_.cells[b].label[e] == body_) visit({b, e}, mesh_.cells[b].tag[e]);
  }
  std::vector<PetscInt> nodesOf(const ElementPlace& place) const {
    return sorted(std::as_const(mesh_.cells[place.block]).nodesOf(place.element));
  }
  int& at(const ElementPlace& place) { return mesh_.cells[place.block].material[place.element]; }

  WholeMesh& mesh_;
  int body_;
  std::unordered_map<PetscInt, ElementPlace> byTag_;
  std::map<std::vector<PetscInt>, ElementPlace> byNodes_;  // made when it is first needed
};

/// Throws Error for a cell that is in no section of its body.
[[noreturn]] void throwNoSection(const WholeMesh& mesh, const GmshModel& model,
                                 const std::vector<GroupRequest>& sections, int body,
                                 PetscInt tag) {
  std::vector<std::string> names, others;
  for (const auto& section : sections) names.push_back(section.name);
  for (const auto& [name, group] : model.groups())
    if (group.dimension == mesh.dimension && name != mesh.bodies[body] && hasElement(group, tag))
      others.push_back(name);
  throw Error("option " + sections[0].option + ": cell " + std::to_string(tag) + " of body '" +
              mesh.bodies[body] + "' is in none of its sections " + joined(names) +
              "; add a group with this cell" +
              (others.empty() ? "" : ", such as " + joined(others)));
}

void assignSections(WholeMesh& mesh, const GmshModel& model,
                    const std::vector<GroupRequest>& sections, int body, const NodeIndex& index) {
  BodyCells cells(mesh, body);
  for (const auto& section : sections) {
    const int number = std::ssize(mesh.materialGroups);
    mesh.materialGroups.push_back({section.name, body, true});
    const std::string option = "option " + section.option;
    for (const auto& block : model.group(section.name, option).blocks)
      for (std::size_t e = 0; e < block.tag.size(); ++e) {
        int* material = cells.materialOf(block, e, index);
        if (!material)
          throw Error(option + ": cell " + std::to_string(block.tag[e]) + " of section '" +
                      section.name + "' is not in the group '" + mesh.bodies[body] +
                      "' of the mesh; give the body a name that is not a group, or let the group "
                      "contain its sections");
        if (*material >= 0 && *material != number)
          throwTwoSections(block.tag[e], mesh.materialGroups[*material].name, section.name,
                           mesh.bodies[body]);
        *material = number;
      }
  }
  if (const PetscInt tag = cells.firstWithout(); tag >= 0)
    throwNoSection(mesh, model, sections, body, tag);
}

}  // namespace

void assignMaterials(WholeMesh& mesh, const GmshModel& model, const Request& request,
                     const NodeIndex& index) {
  for (auto& block : mesh.cells) block.material.assign(block.tag.size(), -1);
  for (int body = 0; body < std::ssize(mesh.bodies); ++body) {
    const auto sections = request.bodySections.find(mesh.bodies[body]);
    if (sections != request.bodySections.end()) {
      assignSections(mesh, model, sections->second, body, index);
      continue;
    }
    const int number = std::ssize(mesh.materialGroups);
    mesh.materialGroups.push_back({mesh.bodies[body], body, false});
    for (auto& block : mesh.cells)
      for (std::size_t e = 0; e < block.tag.size(); ++e)
        if (block.label[e] == body) block.material[e] = number;
  }
}

void rejectTwoSections(const WholeMesh& mesh, const GmshModel& model, const Request& request,
                       int body, PetscInt tag) {
  const auto sections = request.bodySections.find(mesh.bodies[body]);
  if (sections == request.bodySections.end()) return;
  std::vector<std::string> names;
  for (const auto& section : sections->second)
    if (hasElement(model.group(section.name, "option " + section.option), tag))
      names.push_back(section.name);
  if (names.size() > 1) throwTwoSections(tag, names[0], names[1], mesh.bodies[body]);
}

}  // namespace squeal::mesh
