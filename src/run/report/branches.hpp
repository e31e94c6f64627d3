// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tables of the tracked eigenvalues and of the critical frictions.
#include <string>
#include <vector>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns the tracked eigenvalues, by branch and friction, in rows of numbers: active set, branch,
/// friction, speed, pressure, damping, growth rate in 1/s, angular frequency in rad/s, overlap, 1
/// if it is in the band, and 1 if its friction belongs to the sweep.
std::vector<std::vector<double>> branchRows(const analysis::Analysis& analysis);

/// Returns the same as the text of branches.csv.
std::string branchTable(const analysis::Analysis& analysis);

/// Returns the text of critical.csv, with a row for each critical friction.
std::string criticalTable(const analysis::Analysis& analysis);

/// Returns the text of critical_sensitivities.csv, with a row for each parameter of each critical
/// friction.
std::string criticalSensitivityTable(const analysis::Analysis& analysis);

/// Returns the terminal text on both: the critical frictions, and the completeness of the count.
std::string trackingText(const analysis::Analysis& analysis);

}  // namespace squeal::report
