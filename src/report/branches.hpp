#pragma once
/// These functions return the tables of the followed eigenvalues and of the critical frictions.
#include <string>

#include "analysis/analysis.hpp"

namespace squeal::report {

/// Returns branches.csv.
std::string branchTable(const analysis::Analysis& analysis);

/// Returns critical.csv.
std::string criticalTable(const analysis::Analysis& analysis);

/// Returns what the terminal says of both.
std::string followedText(const analysis::Analysis& analysis);

}  // namespace squeal::report
