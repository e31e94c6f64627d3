// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The messages on steady states in the log.
#include <string>

#include "run/analysis/model.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::analysis {

/// Returns a line with the result of the solver.
std::string resultText(const steady::Solution& solution, const contact::Contact& contact);

/// Collective. Warns of a point without a solution, and of sticking nodes beyond their friction
/// limit. Prints the numbers of nodes of sticking interfaces that slide or are left free, and the
/// tensions of bolts. Throws Error if a displacement is not finite.
void reportState(const steady::Solution& solution, const Model& model);

}  // namespace squeal::analysis
