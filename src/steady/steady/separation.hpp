// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Contact whose sides do not separate.
#include <string>

#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Returns the reason to refuse a state if the normal force is tensile at a node with
/// friction that does not separate: Coulomb's law has no friction force there. Otherwise returns an
/// empty text.
std::string pulledFriction(const contact::Contact& contact, const Solution& solution);

}  // namespace squeal::steady
