// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sections of a body that are not joined to its other sections.
#include "run/audit/finding.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// Collective. Returns a warning for each body whose sections do not form one piece. The pieces
/// share no node, and no tie, coupling or bolt joins them. They can move apart although they belong
/// to one body.
Findings detachedFindings(const Subject& model);

}  // namespace squeal::audit
