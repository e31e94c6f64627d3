// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The comma-separated tables of a run.
#include <filesystem>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Collective. Writes the comma-separated tables into `folder`. Throws Error as writeText() does.
void writeTables(const analysis::Analysis& analysis, const std::filesystem::path& folder);

}  // namespace squeal::report
