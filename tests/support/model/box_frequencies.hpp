// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Natural frequencies of a cantilever of 0.1 × 0.04 × 0.02 m, 4 × 2 × 2 cells hex20, clamped at
/// x = 0. The matrices are small and dense.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "algebra/linalg/symmetric.hpp"
#include "support/algebra/sparse.hpp"
#include "support/model/model.hpp"

namespace squeal::test {

inline const std::string smallBox = "order=2,serendipity=1,Lx=0.1,Ly=0.04,Lz=0.02,nx=4,ny=2,nz=2";

/// Collective. Returns the natural frequencies of the bodies without the components that are
/// clamped, in Hz, ascending.
inline std::vector<double> frequenciesOf(const Built& built) {
  const auto k = denseCopy(built.bodies.stiffness), m = denseCopy(built.bodies.mass);
  std::vector<char> held(k.rows(), 0);
  for (const PetscInt node : built.mesh.nodeGroups.at("clamped"))
    for (int d = 0; d < 3; ++d) held[3 * (built.mesh.firstNode + node) + d] = 1;
  check(MPI_Allreduce(MPI_IN_PLACE, held.data(), int(held.size()), MPI_CHAR, MPI_MAX,
                      PETSC_COMM_WORLD));
  std::vector<PetscInt> free;
  for (PetscInt i = 0; i < k.rows(); ++i)
    if (!held[i]) free.push_back(i);
  const PetscInt n = std::ssize(free);
  linalg::DenseMatrix stiffness(n, n), mass(n, n);
  for (PetscInt i = 0; i < n; ++i)
    for (PetscInt j = 0; j < n; ++j) {
      stiffness(i, j) = k(free[i], free[j]);
      mass(i, j) = m(free[i], free[j]);
    }
  auto values = linalg::symmetricEigen(stiffness, mass);
  for (double& value : values) value = std::sqrt(value) / (2 * M_PI);
  return values;
}

/// Collective. Returns the frequencies of the cantilever with this material.
inline std::vector<double> boxFrequencies(const std::string& material) {
  return frequenciesOf(buildBodies("-mesh_file meshes/beam.geo -mesh_set " + smallBox +
                                   " -constraint_clamped_clamped xyz " + material));
}

/// Collective. Compares the lowest frequencies with figures of seven digits and more.
inline void expectFrequencies(const std::string& material, const std::vector<double>& figures) {
  const auto found = boxFrequencies(material);
  for (std::size_t i = 0; i < figures.size(); ++i)
    EXPECT_NEAR(found[i] / figures[i], 1, 1e-8) << material << i;
}

}  // namespace squeal::test
