// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady states in which a contact node is about to open or close: they belong to two active sets.
#include <optional>

#include "model/contact/contact.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Returns a converged solution with the active set `set`; none if it is not a solution
/// on that set. It is one if each node whose state differs has no normal force and no gap within
/// round-off, and its interface does not stick: where a sticking node opens, its tangential force
/// vanishes, so the two sets have different states.
std::optional<Solution> onActiveSet(const contact::Contact& contact, Solution solution,
                                    const contact::ActiveSet& set);

}  // namespace squeal::steady
