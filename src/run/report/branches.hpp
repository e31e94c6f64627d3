// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tables of the tracked eigenvalues and of the critical frictions.
#include <string>
#include <vector>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns a row of numbers for each tracked eigenvalue, ordered by branch and friction: active
/// set, branch, friction, speed, pressure, damping, growth rate in 1/s, angular frequency in rad/s,
/// overlap, 1 if the eigenvalue is in the band (otherwise 0), and 1 if its friction belongs to the
/// sweep (otherwise 0).
std::vector<std::vector<double>> branchRows(const analysis::Analysis& analysis);

/// Returns the text of branches.csv, with these rows and the frequency in Hz.
std::string branchTable(const analysis::Analysis& analysis);

/// Returns the text of critical.csv, with a row for each critical friction.
std::string criticalTable(const analysis::Analysis& analysis);

/// Returns the text of critical_sensitivities.csv, with a row for each parameter of each critical
/// friction.
std::string criticalSensitivityTable(const analysis::Analysis& analysis);

/// Returns the text for the terminal on the critical frictions, and on the completeness of the
/// tracked eigenvalues.
std::string trackingText(const analysis::Analysis& analysis);

}  // namespace squeal::report
