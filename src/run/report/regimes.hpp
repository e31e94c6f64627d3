// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tables of what becomes of unstable modes after flutter.
#include <filesystem>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Collective. Writes onset.csv where there are unstable modes in contact, and regime.csv,
/// regime_nodes.csv, regime_cycles.csv and regime_spectrum.csv where the motion was followed.
void writeRegimes(const analysis::Analysis& analysis, const std::filesystem::path& folder);

}  // namespace squeal::report
