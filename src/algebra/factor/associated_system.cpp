// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/factor/associated_system.hpp"
#include "base/petsc/object.hpp"

namespace squeal::factor {

AssociatedSystem::AssociatedSystem(OwnedMat k0, OwnedMat m0, const std::string& name)
    : k0_(std::move(k0)),
      m0_(std::move(m0)),
      solver_(std::make_unique<SymmetricSolver>(k0_, name)) {
  check(MatGetSize(k0_, &size_, nullptr));
}

MPI_Comm AssociatedSystem::comm() const { return commOf(k0_.get()); }

}  // namespace squeal::factor
