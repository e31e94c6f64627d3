// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Axes of rotation and the bodies that rotate about them.
#include "run/audit/finding.hpp"
#include "run/audit/masses.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// Not collective. Returns findings on axes of rotation that lie slightly off the centre of mass of
/// their bodies, or far from it. Also returns findings on rotating bodies held by couplings, if
/// convective terms act on the rigid tilt of these bodies like a spring of negative stiffness.
Findings rotationFindings(const Subject& model, const std::vector<BodyMass>& masses);

}  // namespace squeal::audit
