// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The output on the proofs of the lists of eigenvalues (`-flutter_proof`).
#include <nlohmann/json.hpp>
#include <string>

#include "eigen/pencil/complex_modes.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// Returns true if a proof was requested at any point. Not collective.
bool hasProofs(const analysis::Analysis& analysis);
/// Returns the text of proof.csv, with a row for each solved point. Not collective.
std::string proofTable(const analysis::Analysis& analysis);
/// Returns the entry on the proof of a point in summary.json. Not collective.
nlohmann::json proofEntry(const pencil::ComplexModes& point);
/// Returns the text for the terminal; empty without proofs. Not collective.
std::string proofText(const analysis::Analysis& analysis);

}  // namespace squeal::report
