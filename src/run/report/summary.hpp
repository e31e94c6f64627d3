// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The summary of a run.
#include <filesystem>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Collective. Writes summary.json into `folder`. Call it after the last stage, since the summary
/// contains the times of all stages. Throws Error as writeText() does.
void writeSummary(const analysis::Analysis& analysis, const std::filesystem::path& folder);

}  // namespace squeal::report
