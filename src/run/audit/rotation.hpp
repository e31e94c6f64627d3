// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Axes of rotation and the bodies that rotate about them.
#include "run/audit/finding.hpp"
#include "run/audit/masses.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// Not collective. Returns findings on axes of rotation that do not pass through the centre of mass
/// of their bodies, and on rotating bodies held by couplings, if convective terms act on their
/// rigid tilt like a spring of negative stiffness.
Findings rotationFindings(const Subject& model, const std::vector<BodyMass>& masses);

}  // namespace squeal::audit
