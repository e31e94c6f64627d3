// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Contact whose sides do not separate, and bodies that only contact holds.
#include <string>

#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Returns the reason to refuse a state if the normal force is tensile at a node with
/// friction that does not separate: Coulomb's law gives no friction force there, and its formula
/// −f R_N τ would push in the direction of motion. The nodes of a sticking interface have friction
/// if they may slide (`_release`). Otherwise returns an empty text.
std::string pulledFriction(const contact::Contact& contact, const Solution& solution);

/// Collective. Returns a hint if only contact prevents a body from moving rigidly: a solution may
/// not exist because the loads pull the body off. Otherwise returns an empty text.
std::string heldByContactOnly(const contact::Contact& contact, const elasticity::Bodies& bodies);

}  // namespace squeal::steady
