// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of a sweep before anything is solved.
#include <vector>

#include "eigen/sweep/sweep.hpp"
#include "problem/matrices/matrices.hpp"
#include "run/analysis/model.hpp"
#include "run/analysis/settings.hpp"

namespace squeal::analysis {

/// Collective. Multiplies the norms of matrices, loads and held displacements by the largest
/// factors that the sweep applies to them. Throws Error if a product is not a finite number.
void requireFiniteSweep(const elasticity::Bodies& bodies, const contact::Contact& contact,
                        const sweep::Sweep& sweep);

/// Collective. Multiplies the norms of the matrices by their coefficients at the ends of the sweep.
/// Throws Error if a product is not a finite number.
void requireFiniteSweep(const std::vector<matrices::NamedTerm>& terms, const sweep::Sweep& sweep);

/// Collective. Throws Error for damping factors other than 1 without damping, speed factors other
/// than 1 without motion, and pressure factors other than 1 without loads: the results would not
/// depend on them.
void rejectIdleFactors(const elasticity::Bodies& bodies, const contact::Contact& contact,
                       const pencil::Settings& pencil, const sweep::Sweep& sweep);

/// Not collective. Throws Error for a sweep over a parameter that multiplies no matrix, since the
/// results at all points would be the same, and for a pressure factor other than 1.
void rejectIdleFactors(const std::vector<matrices::NamedTerm>& terms,
                       const pencil::Settings& pencil, const sweep::Sweep& sweep);

/// Collective. Warns if the dense eigenvalue problems of the sweep will take long. This is
/// estimated from the number of free modes.
void warnOfDenseWork(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep,
                     PetscInt unknowns);

/// Collective. Makes all checks of a model against the sweep. Throws Error as requireSupports(),
/// requireFiniteSweep(), rejectIdleFactors() and regime::requireSupported() do; warns as
/// warnOfDenseWork() does.
void checkModel(const Model& model, const Settings& settings, const sweep::Sweep& sweep);

}  // namespace squeal::analysis
