#pragma once
/// These functions write the comma-separated tables and the stability table of the terminal.
#include <filesystem>
#include <string>

#include "analysis/analysis.hpp"

namespace squeal::report {

/// Collective. Writes the comma-separated tables into `folder`.
void writeTables(const analysis::Analysis& analysis, const std::filesystem::path& folder);

/// Collective. Writes options.txt into `folder`, after all else, when every option has been asked
/// for.
void writeRecipe(const analysis::Analysis& analysis, const std::filesystem::path& folder);

/// Returns the frequencies and growth rates of the unstable modes at each friction.
std::string stabilityTable(const analysis::Analysis& analysis);

}  // namespace squeal::report
