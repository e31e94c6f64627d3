// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/settings.hpp"

#include "base/options/option_types.hpp"

namespace squeal::audit {
namespace {

const FlagOption auditOption(
    "general", "audit", true,
    "audit of the model before the solution: masses, units, supports, cells, and faces without an "
    "interface; written to audit.md, or by a dry run to the terminal");

}  // namespace

bool wanted() { return auditOption.get(); }

}  // namespace squeal::audit
