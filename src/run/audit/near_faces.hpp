// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Faces of two bodies that face each other without a common interface, and coincident nodes that
/// are not merged.
#include "run/audit/finding.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// Collective. Searches around each boundary face, up to a distance of a tenth of its size. Two
/// faces that face each other are a finding if they belong to two bodies, or to two unconnected
/// parts of a body, and to no common interface or coupling. A node is a finding if it belongs to no
/// interface, coupling or periodic boundary, and another node has the same position. Two ranks
/// exchange only faces that may be near each other.
Findings nearFindings(const Subject& model);

}  // namespace squeal::audit
