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

/// Collective. Returns the free modes of a solved point, M-orthonormal, as vectors of all unknowns.
/// `associated` has the terms of K and M.
modes::Modes freeModes(const Basis& basis, const PointState& state,
                       const pencil::Pencil& associated);

/// A list of modes whose completeness needs confirmation; borrowed.
struct CountRange {
  double top;                             ///< upper end of the list, rad/s
  const std::vector<double>& values;      ///< ω² of the reduced problem, ascending
  const std::vector<PetscInt>& boundary;  ///< boundary unknowns of the point
};
/// Collective. Confirms the number of modes if, at some σ (rad²/s²) in a gap above the end of the
/// list, `count` gives as many modes below σ as the reduced problem has values ω² below σ. These
/// values are upper bounds of the exact ones.
void confirmCount(MPI_Comm comm, const subspace::ModeCount& count, const CountRange& range,
                  modes::Modes& modes);

}  // namespace squeal::reduction
