// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The setting of the audit.

namespace squeal::audit {

/// Returns true if the audit is wanted (`-audit`). Not collective: all ranks have the same options.
bool wanted();

}  // namespace squeal::audit
