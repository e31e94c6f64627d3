// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Audits of models from options.
#include <string>
#include <vector>

#include "run/audit/audit.hpp"
#include "support/model/model.hpp"

namespace squeal::test {

/// Collective. Audits the model of the options in force.
inline audit::Audit auditInForce() {
  const Model model = buildModel();
  return audit::auditOf({*model.mesh, model.bodies, model.contact, material::Settings::given(),
                         constraints::Settings::given().couplings});
}

/// Collective. Audits the model of only these options.
inline audit::Audit audited(const std::string& options) {
  setOptions(options);
  return auditInForce();
}

/// Returns the findings as lines: kind, severity, text and remedy.
inline std::string linesOf(const audit::Audit& audit) {
  std::string lines;
  for (const auto& finding : audit.findings)
    lines += audit::text(finding.kind) +
             (finding.severity == audit::Severity::warning ? " (warning): " : " (note): ") +
             finding.text + "; " + finding.remedy + "\n";
  return lines;
}

/// Returns the pieces that the lines of the findings do not contain, joined; empty if there are
/// as many findings as given and all pieces are there.
inline std::string missingIn(const audit::Audit& audit, std::size_t findings,
                             const std::vector<std::string>& pieces) {
  const std::string lines = linesOf(audit);
  std::string missing;
  if (audit.findings.size() != findings)
    missing += std::to_string(audit.findings.size()) + " findings; ";
  for (const auto& piece : pieces)
    if (lines.find(piece) == std::string::npos) missing += "'" + piece + "' ";
  return missing.empty() ? "" : missing + "in:\n" + lines;
}

}  // namespace squeal::test
