// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The stability of a run, for the terminal.
#include <string>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns the terminal text: the frequencies and growth rates of the unstable modes at each point
/// of the sweep, their errors, and critical frictions.
std::string stabilityTable(const analysis::Analysis& analysis);

}  // namespace squeal::report
