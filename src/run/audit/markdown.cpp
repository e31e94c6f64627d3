// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "run/audit/audit.hpp"

namespace squeal::audit {
namespace {

/// Returns a row of a table; a bar in a name would begin another cell.
std::string row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const auto& cell : cells) {
    line += " ";
    for (const char letter : cell) line += letter == '|' ? "\\|" : std::string(1, letter);
    line += " |";
  }
  return line + "\n";
}

std::string tableHead(const std::vector<std::string>& names, std::size_t texts = 1) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < names.size(); ++i) lines.push_back(i < texts ? "---" : "---:");
  std::string rule = "|";
  for (const auto& line : lines) rule += line + "|";
  return row(names) + rule + "\n";
}

std::string number(double value) { return formatted("%.5g", value); }

std::string place(const Point& x) { return formatted("(%.5g, %.5g, %.5g)", x[0], x[1], x[2]); }

/// Returns a value that vanishes in exact arithmetic as zero.
double cleaned(double value, double scale) { return std::abs(value) < 1e-12 * scale ? 0 : value; }

std::string findingsText(const Findings& findings) {
  if (findings.empty()) return "No finding.\n";
  std::string text;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const auto& finding = findings[i];
    const bool isWarning = finding.severity == Severity::warning;
    text += formatted("%zu. **%s, %s**: ", i + 1, isWarning ? "Warning" : "Note",
                      audit::text(finding.kind).c_str());
    text += finding.text + ". *Remedy:* " + finding.remedy + ".\n";
  }
  return text;
}

std::string massTable(const Audit& audit) {
  const bool plane = audit.dimension == 2;
  std::vector<std::string> names{"body", "cells", plane ? "mass, kg/m" : "mass, kg",
                                 "centre of mass, m"};
  if (plane)
    names.push_back("I_zz, kg m");
  else
    for (const char* name : {"I_xx, kg m2", "I_yy", "I_zz", "I_xy", "I_xz", "I_yz"})
      names.push_back(name);
  std::string text = tableHead(names);
  auto bodies = audit.bodies;
  bodies.insert(bodies.end(), audit.points.begin(), audit.points.end());
  bodies.push_back(audit.total);
  for (const auto& body : bodies) {
    const auto& i = body.inertia;
    const double size = mesh::length(mesh::minus(body.high, body.low));
    Point centre = body.centre;
    for (double& x : centre) x = cleaned(x, size);
    std::vector<std::string> cells{body.body, body.cells > 0 ? std::to_string(body.cells) : "",
                                   number(body.mass), place(centre)};
    const double scale = body.mass * size * size;
    constexpr std::size_t components[][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (const auto& [a, b] : components)
      if (!plane || a + b == 4) cells.push_back(number(cleaned(i[a][b], scale)));
    text += row(cells);
  }
  return text;
}

std::string qualityTable(const Audit& audit) {
  std::string text = tableHead(
      {"body", "box from", "to", "wave speed, m/s", "smallest Jacobian ratio", "largest aspect"});
  for (std::size_t b = 0; b < audit.bodies.size(); ++b)
    text += row({audit.bodies[b].body, place(audit.bodies[b].low), place(audit.bodies[b].high),
                 number(audit.waveSpeed[b]), formatted("%.3g", audit.cells[b].jacobian.value),
                 formatted("%.3g", audit.cells[b].aspect.value)});
  return text;
}

std::string supportTable(const Audit& audit) {
  std::string text =
      tableHead({"part", "supports and the number of their nodes", "without contact"}, 3);
  for (const auto& part : audit.parts) {
    std::vector<std::string> words;
    for (const auto& support : part.supports)
      words.push_back(support.by + formatted(": %" PetscInt_FMT, support.nodes));
    text += row({part.part, words.empty() ? "none" : joined(words),
                 part.needsContact ? "loose" : "supported"});
  }
  return text;
}

}  // namespace

std::string summaryOf(const Audit& audit) {
  const auto warnings = std::ranges::count(audit.findings, Severity::warning, &Finding::severity);
  const auto notes = std::ssize(audit.findings) - warnings;
  if (audit.findings.empty()) return "no finding";
  if (notes == 0) return counted(warnings, "warning");
  if (warnings == 0) return counted(notes, "note");
  return counted(warnings, "warning") + " and " + counted(notes, "note");
}

std::string markdown(const Audit& audit) {
  return "# Audit of the model\n\n"
         "Units are named as in SI.\n\n"
         "## Findings\n\n" +
         findingsText(audit.findings) +
         "\n## Masses\n\n"
         "The moments of inertia I refer to the centre of mass and to the axes x, y, z: "
         "I_xx is the integral of rho (y^2 + z^2), I_xy that of -rho x y.\n\n" +
         massTable(audit) +
         "\n## Size and quality\n\n"
         "The Jacobian ratio is the smallest determinant of a cell over its largest one. The "
         "aspect is the condition number of the Jacobian: 1 for a cube, about half of the ratio of "
         "the lengths of a long cell.\n\n" +
         qualityTable(audit) +
         "\n## Parts and their supports\n\n"
         "A part that is loose without contact is held by contact only.\n\n" +
         supportTable(audit);
}

}  // namespace squeal::audit
