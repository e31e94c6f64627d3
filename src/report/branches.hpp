#pragma once
/// These functions return the tables of the followed eigenvalues and of the critical frictions.
#include <string>

#include "analysis/analysis.hpp"

namespace squeal::report {

/// Returns the text of branches.csv: the eigenvalues followed, by branch and friction.
std::string branchTable(const analysis::Analysis& analysis);

/// Returns the text of critical.csv, with a row for each critical friction.
std::string criticalTable(const analysis::Analysis& analysis);

/// Returns the text of the terminal on both: the critical frictions, and how complete the count is.
std::string followedText(const analysis::Analysis& analysis);

}  // namespace squeal::report
