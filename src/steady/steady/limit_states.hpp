// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady states in which a contact node is about to open or close: they belong to two active sets.
#include <optional>

#include "model/contact/contact.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Returns true if a converged solution is also one on the active set `set`: if each
/// node whose state differs has no normal force and no gap within round-off, and its interface does
/// not stick. (Where a sticking node opens, its tangential force vanishes, so the two sets have
/// different states.)
bool isOnActiveSet(const contact::Contact& contact, const Solution& solution,
                   const contact::ActiveSet& set);

/// Collective. Returns the solution with the active set `set`; none if it is not one on that set.
std::optional<Solution> onActiveSet(const contact::Contact& contact, Solution solution,
                                    const contact::ActiveSet& set);

}  // namespace squeal::steady
