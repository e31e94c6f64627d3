// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/factor/associated_system.hpp"

#include <algorithm>

#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"

namespace squeal::factor {

PetscInt zeroRows(Mat matrix) {
  PetscInt first = 0, end = 0, zeros = 0;
  check(MatGetOwnershipRange(matrix, &first, &end));
  for (PetscInt row = first; row < end; ++row) {
    PetscInt count = 0;
    const PetscScalar* values = nullptr;
    check(MatGetRow(matrix, row, &count, nullptr, &values));
    zeros += std::all_of(values, values + count, [](PetscScalar value) { return value == 0; });
    check(MatRestoreRow(matrix, row, &count, nullptr, &values));
  }
  return mpi::sum(commOf(matrix), zeros);
}

AssociatedSystem::AssociatedSystem(OwnedMat k0, OwnedMat m0, const std::string& name)
    : k0_(std::move(k0)),
      m0_(std::move(m0)),
      solver_(std::make_unique<SymmetricSolver>(k0_, name)) {
  check(MatGetSize(k0_, &size_, nullptr));
}

MPI_Comm AssociatedSystem::comm() const { return commOf(k0_.get()); }

}  // namespace squeal::factor
