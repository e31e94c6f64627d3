// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The stability of a run as the terminal shows it.
#include <string>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns the text of the terminal: the frequencies and growth rates of the unstable modes at each
/// point of the sweep, their errors, and critical frictions.
std::string stabilityTable(const analysis::Analysis& analysis);

}  // namespace squeal::report
