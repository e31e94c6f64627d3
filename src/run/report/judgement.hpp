// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The judgement of a list of eigenvalues: as a table, in the summary and on the terminal.
#include <nlohmann/json.hpp>
#include <string>

#include "run/analysis/matrix_referee.hpp"

namespace squeal::report {

/// Returns referee.csv: a row for each entry of the list, then one for each missing eigenvalue.
std::string refereeTable(const analysis::JudgedList& judged);
/// Returns the entry `referee` of the summary.
nlohmann::ordered_json refereeEntry(const analysis::JudgedList& judged);
/// Returns the text for the terminal: the verdict, and each entry that is not right.
std::string refereeText(const analysis::JudgedList& judged);

}  // namespace squeal::report
