// SPDX-License-Identifier: BSD-2-Clause
#include "model/coupling/exchange.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"

namespace squeal::coupling {

NodeExchange::NodeExchange(const mesh::Mesh& mesh) : mesh_(mesh), primary_(mesh.globalNode) {
  check(VecCreateMPI(mesh.comm, mesh.ownedNodes, PETSC_DETERMINE, global_.out()));
  check(VecCreateSeq(PETSC_COMM_SELF, mesh.localNodes(), local_.out()));
  connect();
  // Only the owner of an image has its primary; node numbers are exact as doubles.
  std::vector<double> primaries(mesh.localNodes(), 0.0);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) primaries[node] = mesh.globalNode[node];
  for (const auto& image : mesh.images) primaries[image.node] = image.primary;
  sum(primaries);
  for (std::size_t node = 0; node < primaries.size(); ++node)
    primary_[node] = PetscInt(primaries[node]);
  connect();
}

void NodeExchange::connect() {
  OwnedIS nodes;
  check(ISCreateGeneral(PETSC_COMM_SELF, primary_.size(), primary_.data(), PETSC_COPY_VALUES,
                        nodes.out()));
  check(VecScatterCreate(global_, nodes, local_, nullptr, scatter_.out()));
}

PetscInt NodeExchange::local(PetscInt globalNode) const {
  const PetscInt owned = globalNode - mesh_.firstNode;
  if (owned >= 0 && owned < mesh_.ownedNodes) return owned;
  const auto ghosts = mesh_.globalNode.begin() + mesh_.ownedNodes;
  return std::lower_bound(ghosts, mesh_.globalNode.end(), globalNode) - mesh_.globalNode.begin();
}

void NodeExchange::combine(std::vector<double>& values, InsertMode mode) const {
  std::copy(values.begin(), values.end(), WriteArray(local_).begin());
  check(VecSet(global_, 0));
  check(VecScatterBegin(scatter_, local_, global_, mode, SCATTER_REVERSE));
  check(VecScatterEnd(scatter_, local_, global_, mode, SCATTER_REVERSE));
  check(VecScatterBegin(scatter_, global_, local_, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter_, global_, local_, INSERT_VALUES, SCATTER_FORWARD));
  const ReadArray found(local_);
  std::copy(found.begin(), found.end(), values.begin());
}

}  // namespace squeal::coupling
