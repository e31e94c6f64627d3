#pragma once
/// These functions write the comma-separated tables, and return the stability table of the
/// terminal.
#include <filesystem>
#include <string>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Collective. Writes the comma-separated tables into `folder`. Throws Error as writeText() does.
void writeTables(const analysis::Analysis& analysis, const std::filesystem::path& folder);

/// Collective. Writes options.txt into `folder`, after all else, when every option has been asked
/// for.
void writeRecipe(const analysis::Analysis& analysis, const std::filesystem::path& folder);

/// Returns the text of the terminal: the frequencies and growth rates of the unstable modes at each
/// point of the sweep, what is known of their errors, and critical frictions.
std::string stabilityTable(const analysis::Analysis& analysis);

}  // namespace squeal::report
