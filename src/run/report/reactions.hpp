// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The table of the forces and moments by which the bodies are supported and joined.
#include <string>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Collective. Returns reactions.csv.
std::string reactionTable(const analysis::Analysis& analysis);

}  // namespace squeal::report
