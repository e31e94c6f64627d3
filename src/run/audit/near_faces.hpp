// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Faces of two bodies that face each other without a common interface, and coincident nodes that
/// are not merged.
#include "run/audit/finding.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// Collective. Searches around each boundary face, to a tenth of its size. Faces of two bodies, or
/// of two parts of a body, are a finding if they face each other and belong to no common interface
/// or coupling. Two nodes are a finding if they have the same position but different numbers, and
/// the first belongs to no interface, coupling or periodic boundary. Ranks exchange only faces that
/// are near faces of each other.
Findings nearFindings(const Subject& model);

}  // namespace squeal::audit
