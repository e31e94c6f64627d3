// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of a sweep before anything is solved.
#include <vector>

#include "eigen/sweep/sweep.hpp"
#include "problem/matrices/matrices.hpp"
#include "run/analysis/model.hpp"
#include "run/analysis/settings.hpp"

namespace squeal::analysis {

/// Collective. Throws Error if a matrix, a load or the held displacements, times the largest factor
/// that the sweep multiplies it by, has a norm that is not a finite number.
void requireFiniteSweep(const elasticity::Bodies& bodies, const contact::Contact& contact,
                        const sweep::Sweep& sweep);

/// Collective. Throws Error if a matrix, times its coefficient at an end of the sweep, has a norm
/// that is not a finite number.
void requireFiniteSweep(const std::vector<matrices::NamedTerm>& terms, const sweep::Sweep& sweep);

/// Collective. Throws Error for damping, speed or pressure factors other than 1 if there is no
/// damping, motion or load, since the results would not depend on them.
void rejectIdleFactors(const elasticity::Bodies& bodies, const contact::Contact& contact,
                       const pencil::Settings& pencil, const sweep::Sweep& sweep);

/// Not collective. Throws Error for a sweep over a parameter that multiplies no matrix, since all
/// its points would be the same, and for a pressure factor other than 1.
void rejectIdleFactors(const std::vector<matrices::NamedTerm>& terms,
                       const pencil::Settings& pencil, const sweep::Sweep& sweep);

/// Collective. Warns of a sweep whose dense eigenvalue problems take long, judged by the number of
/// free modes.
void warnOfDenseWork(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep,
                     PetscInt unknowns);

/// Collective. All checks of a model against the sweep. Throws Error as requireFiniteSweep(),
/// rejectIdleFactors() and regime::requireSupported() do; warns as warnOfDenseWork() does.
void checkModel(const Model& model, const Settings& settings, const sweep::Sweep& sweep);

}  // namespace squeal::analysis
