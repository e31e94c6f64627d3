// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/references.hpp"

#include "base/system/error.hpp"

namespace squeal::mesh {
namespace {

void addReference(WholeMesh& mesh, const std::string& name, const Point& position) {
  const PetscInt first = mesh.nodeCount();
  for (int node : {0, 1}) {
    mesh.points.push_back(position);
    mesh.tags.push_back(-node);  // no tag of gmsh
  }
  mesh.references.push_back({name, position, first, first + 1, -1});
  mesh.nodeGroups[name] = {first};
}

}  // namespace

void addReferences(WholeMesh& mesh, const GmshModel& model, const Request& request) {
  for (const auto& wanted : request.references) {
    const std::string head = "option " + wanted.option + ": ";
    if (model.groups().contains(wanted.name))
      throw Error(head + "a group of the mesh has the name '" + wanted.name +
                  "' already; give the reference node another name");
    const Point position = wanted.position
                               ? wanted.position->in(mesh.dimension)
                               : centroid(mesh, mesh.nodeGroups.at(wanted.centreOf.name));
    addReference(mesh, wanted.name, position);
  }
  for (auto& section : mesh.sections) {
    std::vector<PetscInt> nodes;
    for (const auto& pair : mesh.sectionPairs)
      if (&mesh.sections[pair.section] == &section) nodes.push_back(pair.lower);
    section.reference = std::ssize(mesh.references);
    // A blank cannot occur in the name of a group.
    addReference(mesh, "bolt " + section.name, centroid(mesh, nodes));
  }
}

}  // namespace squeal::mesh
