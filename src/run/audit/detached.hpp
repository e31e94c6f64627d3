// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sections of a body that nothing joins to its other sections.
#include "run/audit/finding.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// Collective. Returns a warning for each body whose sections do not form one piece: they share no
/// node, and no tie, coupling or bolt joins them, so they move apart although they have one name.
Findings detachedFindings(const Subject& model);

}  // namespace squeal::audit
