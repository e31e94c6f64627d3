// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Axes of rotation and the bodies that rotate about them.
#include "run/audit/finding.hpp"
#include "run/audit/masses.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// Not collective. Compares the axis of each rotation with the centre of mass of the bodies that
/// share it.
Findings rotationFindings(const Subject& model, const std::vector<BodyMass>& masses);

}  // namespace squeal::audit
