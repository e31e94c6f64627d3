#pragma once
/// Checks of a sweep before anything is solved.
#include <vector>

#include "contact/contact.hpp"
#include "elasticity/elasticity.hpp"
#include "matrices/matrices.hpp"
#include "sweep/sweep.hpp"

namespace squeal::analysis {

/// Collective. Error where a matrix or a load of the bodies, times what the sweep multiplies it by,
/// is not a number.
void requireFiniteSweep(const elasticity::Bodies& bodies, const contact::Contact& contact,
                        const sweep::Sweep& sweep);

/// Collective. Error where the coefficient of a matrix, at an end of the sweep, makes something of
/// it that is not a number.
void requireFiniteSweep(const std::vector<matrices::NamedTerm>& terms, const sweep::Sweep& sweep);

/// Collective. Error for a sweep over a factor of nothing: all its points would be the same.
void rejectIdleFactors(const elasticity::Bodies& bodies, const contact::Contact& contact,
                       const sweep::Sweep& sweep);

/// Error for a sweep over a parameter that no matrix comes with: all its points would be the same.
void rejectIdleFactors(const std::vector<matrices::NamedTerm>& terms, const sweep::Sweep& sweep);

}  // namespace squeal::analysis
