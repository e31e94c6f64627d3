// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The free modes of points with boundary unknowns, from the reduced problem.
#include <vector>

#include "eigen/modes/modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/subspace/basis.hpp"
#include "eigen/subspace/mode_count.hpp"

namespace squeal::reduction {

/// Returns the terms of K and M only.
pencil::Pencil associatedTerms(const pencil::Pencil& pencil);

/// Collective. Returns the free modes of a solved point, M-orthonormal, with the entries of all
/// unknowns. `associated` has the terms of K and M.
modes::Modes freeModes(const Basis& basis, const PointState& state,
                       const pencil::Pencil& associated);

/// A list of modes whose completeness is to be confirmed; borrowed.
struct CountRange {
  double top;                             ///< upper end of the list, rad/s
  const std::vector<double>& values;      ///< ω² of the reduced problem, ascending
  const std::vector<PetscInt>& boundary;  ///< boundary unknowns of the modes
};
/// Collective. Confirms the number of the modes: at σ in one of the gaps above the end of the list,
/// they are as many as the ω² of the reduced problem, which lie above those that they belong to.
void confirmCount(MPI_Comm comm, const subspace::ModeCount& count, const CountRange& range,
                  modes::Modes& modes);

}  // namespace squeal::reduction
