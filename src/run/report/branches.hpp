// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// These functions return the tables of the followed eigenvalues and of the critical frictions.
#include <string>
#include <vector>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns the eigenvalues followed, by branch and friction, in rows of numbers: active set,
/// branch, friction, speed, pressure, damping, growth rate in 1/s, angular frequency in rad/s,
/// overlap, and 1 if it is in the band and if its friction is one of the sweep.
std::vector<std::vector<double>> branchRows(const analysis::Analysis& analysis);

/// Returns the same as the text of branches.csv.
std::string branchTable(const analysis::Analysis& analysis);

/// Returns the text of critical.csv, with a row for each critical friction.
std::string criticalTable(const analysis::Analysis& analysis);

/// Returns the text of the terminal on both: the critical frictions, and how complete the count is.
std::string followedText(const analysis::Analysis& analysis);

}  // namespace squeal::report
