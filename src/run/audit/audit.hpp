// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The audit of a model before anything is solved: its masses, its supports, and findings. A
/// finding is a property that may be a mistake, although the model can be solved.
#include <string>
#include <vector>

#include "run/audit/cells.hpp"
#include "run/audit/finding.hpp"
#include "run/audit/masses.hpp"
#include "run/audit/subject.hpp"
#include "run/audit/supports.hpp"
#include "run/audit/units.hpp"

namespace squeal::audit {

/// The results of an audit. They are the same on all ranks and, within round-off, for any number of
/// ranks.
struct Audit {
  int dimension = 3;
  std::vector<BodyMass> bodies;    ///< [body]
  std::vector<BodyMass> points;    ///< point masses
  BodyMass total;                  ///< of bodies and point masses
  std::vector<double> waveSpeed;   ///< √(E/ρ) with the largest modulus E, [body], m/s
  std::vector<CellQuality> cells;  ///< [body]
  std::vector<PartSupports> parts;
  Findings findings;  ///< warnings first
};

/// Collective. Audits a model.
Audit auditOf(const Subject& model);

/// Returns a name of a few words for a kind of finding.
std::string text(Kind kind);
/// Returns a line for the log with the number of findings.
std::string summaryOf(const Audit& audit);
/// Returns the audit as a text in Markdown.
std::string markdown(const Audit& audit);

}  // namespace squeal::audit
