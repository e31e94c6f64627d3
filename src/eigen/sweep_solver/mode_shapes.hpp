// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Free modes as nodal displacements, and as vectors of all unknowns.
#include <vector>

#include "base/petsc/owned.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/subspace/basis.hpp"

namespace squeal::sweep_solver {

/// Collective. Returns the first modes, at most `most`, as nodal displacements T d with a largest
/// entry of magnitude 1. `trial` is T.
std::vector<OwnedVec> reportedShapes(const modes::Modes& modes, Mat trial, int most);

/// Collective. Extends the vectors of modes of the interior unknowns to all unknowns.
modes::Modes onAllUnknowns(const modes::Modes& interior, const subspace::Basis& basis);

}  // namespace squeal::sweep_solver
