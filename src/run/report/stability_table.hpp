// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The stability of a run, for the terminal.
#include <string>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns the text for the terminal: frequencies and growth rates of the unstable modes at each
/// point of the sweep, the errors, and the critical frictions.
std::string stabilityTable(const analysis::Analysis& analysis);

}  // namespace squeal::report
