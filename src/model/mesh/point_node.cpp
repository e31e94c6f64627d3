// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/point_node.hpp"

#include "base/system/concatenation.hpp"
#include "base/system/error.hpp"

namespace squeal::mesh {

PointNode pointNode(const Mesh& mesh, const std::string& name, const std::string& head) {
  if (const Reference* reference = mesh.reference(name))
    return {reference->displacement, reference->rotation, reference->position};
  std::vector<PointNode> own;
  for (PetscInt node : mesh.nodeGroups.at(name))
    own.push_back({mesh.firstNode + node, -1, mesh.coordinates[node]});
  if (own.size() > 2) own.resize(2);  // two are too many already
  const auto all = concatenated(mesh.comm, own);
  if (all.size() != 1)
    throw Error(head + "group '" + name + "' has " + (all.empty() ? "no node" : "several nodes") +
                "; it must have one, or be a reference node");
  return all[0];
}

}  // namespace squeal::mesh
