// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/wrench.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"

namespace squeal::steady {

Point componentsAt(const mesh::Mesh& mesh, const double* values, PetscInt node) {
  Point found{};
  std::copy_n(values + mesh.dimension * node, mesh.dimension, found.begin());
  return found;
}

Wrench ownWrench(const mesh::Mesh& mesh, Vec forces) {
  Wrench sum;
  const ReadArray values(forces);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    sum.addNode(mesh, node, componentsAt(mesh, values.data(), node));
  return sum;
}

void reduce(MPI_Comm comm, const std::vector<Wrench*>& wrenches) {
  std::vector<double> values;
  for (const Wrench* wrench : wrenches) {
    values.insert(values.end(), wrench->force.begin(), wrench->force.end());
    values.insert(values.end(), wrench->moment.begin(), wrench->moment.end());
  }
  mpi::reduce<double>(comm, values, MPI_SUM);
  auto next = values.begin();
  for (Wrench* wrench : wrenches)
    for (Point* part : {&wrench->force, &wrench->moment}) {
      std::copy_n(next, part->size(), part->begin());
      next += part->size();
    }
}

}  // namespace squeal::steady
