// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tall matrices by this rank's rows, one column after the other by PETSc's vectors.
#include <algorithm>
#include <cmath>

#include "algebra/factor/associated_system.hpp"
#include "algebra/linalg/block.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"
#include "support/algebra/dense.hpp"
#include "support/run/case.hpp"

namespace squeal::test {

/// Collective. Returns what `map(from, to)` makes of each column, with vectors distributed like
/// those of a square matrix.
template <class Map>
linalg::Block mapped(Mat layout, const linalg::Block& x, const Map& map) {
  OwnedVec from, to;
  check(MatCreateVecs(layout, from.out(), to.out()));
  linalg::Block result(x.rows(), x.columns());
  for (PetscInt j = 0; j < x.columns(); ++j) {
    std::ranges::copy(x.column(j), WriteArray(from).begin());
    map(from.get(), to.get());
    std::ranges::copy(ReadArray(to), result.column(j).begin());
  }
  return result;
}

/// Collective. Returns A X.
inline linalg::Block times(Mat matrix, const linalg::Block& x) {
  return mapped(matrix, x, [&](Vec from, Vec to) { check(MatMult(matrix, from, to)); });
}

/// Collective. Returns Aᵀ X.
inline linalg::Block timesTransposed(Mat matrix, const linalg::Block& x) {
  return mapped(matrix, x, [&](Vec from, Vec to) { check(MatMultTranspose(matrix, from, to)); });
}

/// Collective. Returns the largest energy norm of what K0⁻¹ of these forces has outside of a basis
/// that is orthonormal in energy.
inline double energyOutside(const factor::AssociatedSystem& system, const linalg::Block& basis,
                            const linalg::Block& forces) {
  const MPI_Comm comm = system.comm();
  linalg::Block responses(forces.rows(), forces.columns());
  const OwnedMat from = linalg::borrowed(comm, system.size(), forces),
                 to = linalg::borrowed(comm, system.size(), responses);
  check(KSPMatSolve(system.solver(), from, to));
  const auto energy = linalg::transposedProduct(comm, forces, responses),
             parts = linalg::transposedProduct(comm, basis, forces);
  double worst = 0;
  for (PetscInt j = 0; j < forces.columns(); ++j) {
    double rest = energy(j, j);
    for (const double part : parts.column(j)) rest -= part * part;
    worst = worse(worst, std::sqrt(worse(0, rest)));
  }
  return worst;
}

/// Collective. Returns the largest magnitude of the entries on all ranks.
inline double largestOfAll(const linalg::DenseView& block) { return largest(largestEntry(block)); }

}  // namespace squeal::test
