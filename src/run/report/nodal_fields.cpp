// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/nodal_fields.hpp"

#include "base/petsc/arrays.hpp"
#include "model/elasticity/elasticity.hpp"

namespace squeal::report {

using fieldfile::Field;

Ghosts::Ghosts(const mesh::Mesh& mesh) : mesh_(mesh) {
  OwnedIS from;
  check(ISCreateBlock(mesh.comm, mesh.dimension, mesh.localNodes(), mesh.globalNode.data(),
                      PETSC_COPY_VALUES, from.out()));
  check(VecCreateSeq(PETSC_COMM_SELF, mesh.dimension * mesh.localNodes(), local_.out()));
  const OwnedVec global = elasticity::nodalVector(mesh);
  check(VecScatterCreate(global, from, local_, nullptr, scatter_.out()));
}

Field Ghosts::vector(const std::string& name, Vec u) const {
  check(VecScatterBegin(scatter_, u, local_, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter_, u, local_, INSERT_VALUES, SCATTER_FORWARD));
  Field field{name, 3, {}};
  const ReadArray values(local_);
  for (PetscInt node = 0; node < mesh_.localNodes(); ++node)
    for (int d = 0; d < 3; ++d)
      field.values.push_back(d < mesh_.dimension ? values[mesh_.dimension * node + d] : 0.0);
  return field;
}

Field Ghosts::scalar(const std::string& name, Vec u, std::size_t component) const {
  const Field all = vector(name, u);
  Field field{name, 1, {}};
  for (std::size_t i = component; i < all.values.size(); i += 3)
    field.values.push_back(all.values[i]);
  return field;
}

}  // namespace squeal::report
