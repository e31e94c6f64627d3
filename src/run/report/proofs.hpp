// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// What is proved about the lists of eigenvalues (`-flutter_proof`).
#include <nlohmann/json.hpp>
#include <string>

#include "eigen/pencil/complex_modes.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns true if a proof is wanted at any point. Not collective.
bool hasProofs(const analysis::Analysis& analysis);
/// Returns the text of proof.csv, with a row for each point that is solved. Not collective.
std::string proofTable(const analysis::Analysis& analysis);
/// Returns the entry of a point in summary.json. Not collective.
nlohmann::json proofEntry(const pencil::ComplexModes& point);
/// Returns the terminal text; empty without proofs. Not collective.
std::string proofText(const analysis::Analysis& analysis);

}  // namespace squeal::report
