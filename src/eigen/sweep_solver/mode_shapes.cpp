// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/mode_shapes.hpp"

#include <algorithm>

#include "algebra/linalg/columns.hpp"
#include "base/petsc/check.hpp"

namespace squeal::sweep_solver {

std::vector<OwnedVec> reportedShapes(const modes::Modes& modes, Mat trial, int most) {
  std::vector<OwnedVec> shapes;
  const int count = std::min<std::size_t>(most, modes.angularFrequency.size());
  for (int i = 0; i < count; ++i) {
    Vec d = nullptr;
    OwnedVec u;
    PetscReal largest = 0;
    check(MatCreateVecs(trial, nullptr, u.out()));
    check(BVGetColumn(modes.vectors, i, &d));
    check(MatMult(trial, d, u));
    check(BVRestoreColumn(modes.vectors, i, &d));
    check(VecNorm(u, NORM_INFINITY, &largest));
    check(VecScale(u, 1 / largest));
    shapes.push_back(std::move(u));
  }
  return shapes;
}

modes::Modes onAllUnknowns(const modes::Modes& interior, const subspace::Basis& basis) {
  const linalg::ReadColumns vectors(interior.vectors);
  modes::Modes all;
  all.lambda = interior.lambda;
  all.angularFrequency = interior.angularFrequency;
  all.relativeResidual = interior.relativeResidual;
  all.vectors = linalg::copiedColumns(basis.stiffness(), basis.prolonged(vectors.view()));
  all.iterations = interior.iterations;
  all.countConfirmed = interior.countConfirmed;
  all.inertiaCount = interior.inertiaCount;
  all.inertiaShift = interior.inertiaShift;
  all.rounding = interior.rounding;
  return all;
}

}  // namespace squeal::sweep_solver
