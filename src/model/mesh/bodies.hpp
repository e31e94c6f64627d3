// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The cells of the bodies and their nodes. Not collective: for rank 0 only.
#include "model/mesh/gmsh_model.hpp"
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// A NodeIndex maps nodes of the gmsh model to indices into WholeMesh::points. It borrows the mesh
/// and the model during its lifetime.
class NodeIndex {
 public:
  NodeIndex(WholeMesh& mesh, const GmshModel& model)
      : mesh_(mesh), model_(model), index_(model.nodeCount(), -1) {}
  /// Replaces nodes of the gmsh model by indices into WholeMesh::points. Adds new nodes there.
  void add(std::vector<PetscInt>& nodes) {
    for (auto& node : nodes) {
      auto& index = index_[node];
      if (index < 0) {
        index = mesh_.nodeCount();
        mesh_.points.push_back(model_.point(node));
        mesh_.tags.push_back(model_.tag(node));
      }
      node = index;
    }
  }
  /// Returns the number of nodes of the file that were not added, except those at points of the
  /// geometry (GmshModel::isOfMesh()).
  PetscInt countUnused() const {
    PetscInt count = model_.droppedNodes();
    for (PetscInt node = 0; node < model_.nodeCount(); ++node)
      if (index_[node] < 0 && model_.isOfMesh(node)) ++count;
    return count;
  }
  /// Replaces nodes of the gmsh model by indices into WholeMesh::points. Returns false if a node
  /// has not been added.
  bool translate(std::vector<PetscInt>& nodes) const {
    for (auto& node : nodes) {
      node = index_[node];
      if (node < 0) return false;
    }
    return true;
  }

 private:
  WholeMesh& mesh_;
  const GmshModel& model_;
  std::vector<PetscInt> index_;
};

/// Fills bodies, material groups, dimension, cells, points and tags of the mesh. Throws Error for a
/// missing group, for a body that is not a volume (a surface of a plane mesh), for cells of an
/// unsupported type, for a cell without a body or with two, for a cell that is in none of the
/// sections of its body or in two of them, for a section with cells of another body, for a cell
/// that occurs twice or has a node twice, and for a plane mesh that does not lie in a plane z =
/// constant.
void readBodies(WholeMesh& mesh, const GmshModel& model, const Request& request, NodeIndex& index);

}  // namespace squeal::mesh
