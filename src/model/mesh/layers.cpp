// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/layers.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace squeal::mesh {

void addLayers(WholeMesh& mesh, const Request& request) {
  std::set<PetscInt> nodes;
  for (const auto& interface : request.interfaces)
    for (const auto& surface : interface.layered)
      for (const auto& block : mesh.faces)
        for (std::size_t e = 0; e < block.tag.size(); ++e)
          if (mesh.surfaces[block.label[e]] == surface) {
            const auto face = block.nodesOf(e);
            nodes.insert(face.begin(), face.end());
          }
  std::map<PetscInt, PetscInt> layerOf;
  for (const PetscInt node : nodes) {
    const PetscInt layer = layerOf[node] = mesh.nodeCount();
    mesh.points.push_back(Point(mesh.points[node]));
    mesh.tags.push_back(-1 - mesh.tags[node]);  // below those of reference nodes, 0 and −1
    mesh.part.push_back(int(mesh.part[node]));
    mesh.primary.push_back(layer);
    mesh.layers.push_back({node, layer});
  }
  for (std::size_t i = 0, images = mesh.images.size(); i < images; ++i) {
    Image image = mesh.images[i];
    const auto own = layerOf.find(image.node), primary = layerOf.find(image.primary);
    if (own == layerOf.end() || primary == layerOf.end()) continue;
    image.node = own->second, image.primary = primary->second;
    mesh.primary[image.node] = image.primary;
    mesh.images.push_back(image);
  }
}

}  // namespace squeal::mesh
