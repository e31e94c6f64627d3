// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Contact whose sides do not separate, and bodies that only contact holds.
#include <string>

#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Returns the reason to refuse a state, or an empty text. A state is refused if the
/// normal force is tensile at a node that has friction and does not separate: Coulomb's law gives
/// no friction force there, and its formula −f R_N τ would push in the direction of motion. The
/// nodes of a sticking interface have friction if they may slide (`_release`).
std::string pulledFriction(const contact::Contact& contact, const Solution& solution);

/// Collective. If only contact prevents a body from moving rigidly, returns a hint that a solution
/// may not exist because the loads pull the body off. Otherwise returns an empty text.
std::string heldByContactOnly(const contact::Contact& contact, const elasticity::Bodies& bodies);

}  // namespace squeal::steady
