// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tables of the motion after flutter.
#include <filesystem>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Collective. Writes onset.csv if the onsets of unstable modes are known. Writes the tables
/// regime*.csv if the motion after flutter was computed, and periodic*.csv and floquet.csv if
/// periodic motions were requested too.
void writeRegimes(const analysis::Analysis& analysis, const std::filesystem::path& folder);

}  // namespace squeal::report
