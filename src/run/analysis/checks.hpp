// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// These functions check a sweep before anything is solved.
#include <vector>

#include "eigen/sweep/sweep.hpp"
#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"
#include "problem/matrices/matrices.hpp"
#include "run/analysis/settings.hpp"

namespace squeal::analysis {

/// Not collective. Sets the swept friction to zero where no interface has it, since all sliding
/// ones have a coefficient of their own. Throws Error if `-flutter_friction` gives another one.
void settleFriction(const contact::Contact& contact, bool frictionGiven, sweep::Sweep& sweep);

/// Collective. Throws Error if a matrix, a load or the held displacements, times the largest factor
/// that the sweep multiplies it by, has a norm that is not a finite number.
void requireFiniteSweep(const elasticity::Bodies& bodies, const contact::Contact& contact,
                        const sweep::Sweep& sweep);

/// Collective. Throws Error if a matrix, times its coefficient at an end of the sweep, has a norm
/// that is not a finite number.
void requireFiniteSweep(const std::vector<matrices::NamedTerm>& terms, const sweep::Sweep& sweep);

/// Collective. Throws Error for damping or pressure factors other than 1 where there is nothing
/// that they multiply: the results would not depend on them.
void rejectIdleFactors(const elasticity::Bodies& bodies, const contact::Contact& contact,
                       const pencil::Settings& pencil, const sweep::Sweep& sweep);

/// Not collective. Throws Error for a sweep over a parameter that no matrix comes with, since all
/// its points would be the same, and for a pressure factor other than 1.
void rejectIdleFactors(const std::vector<matrices::NamedTerm>& terms,
                       const pencil::Settings& pencil, const sweep::Sweep& sweep);

/// Collective. Warns of a sweep whose dense eigenvalue problems take long, by the number of free
/// modes, which is not above that of the unknowns.
void warnOfDenseWork(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep,
                     PetscInt unknowns);

}  // namespace squeal::analysis
