// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/judgement.hpp"

#include <cmath>

#include "base/system/text.hpp"

namespace squeal::report {
namespace {

using referee::Verdict;

constexpr double turn = 2 * M_PI;

std::string pair(Complex s) { return formatted("%.15e,%.15e", s.real(), s.imag()); }

/// Returns s with its frequency. A growth rate within the radius of the disc has no sign.
std::string placeText(Complex s, double radius = 0) {
  return formatted("%.8g Hz, %.6g 1/s", s.imag() / turn + 0.0,  // + 0.0: not -0
                   std::abs(s.real()) <= radius ? 0 : s.real());
}

std::string lineOf(const referee::Row& row, const eigenlist::List& list) {
  const std::string entry =
      row.entry ? formatted("entry %ld (", list.numbers[*row.entry]) + placeText(row.listed) + ")"
                : "";
  const std::string proved = row.proved ? placeText(*row.proved, row.radius) + " (radius " +
                                              roundedUp(row.radius, 2) + " rad/s)"
                                        : "";
  switch (row.verdict) {
    case Verdict::inexact:
      return entry + formatted(" is inexact by %.3g rad/s: the eigenvalue is ", row.distance) +
             proved;
    case Verdict::repeated:
      return entry +
             " is one entry too many: the eigenvalues there have other entries; the nearest is " +
             proved;
    case Verdict::artefact:
      return entry + " is an artefact: " +
             (row.proved ? formatted("the nearest eigenvalue is %.3g rad/s away", row.distance)
                         : "no eigenvalue of the region has Im s >= 0");
    case Verdict::missing:
      return "missing: " + proved;
    case Verdict::unproved:
      return entry.empty() ? "near " + placeText(row.listed) +
                                 " nothing is proved, and the list has no entry there"
                           : entry + ": nothing is proved here";
    default:
      return "";
  }
}

}  // namespace

std::string refereeTable(const analysis::JudgedList& judged) {
  std::string table =
      "entry,growth_rate_1_per_s,angular_frequency_rad_per_s,verdict,proved_growth_rate_1_per_s,"
      "proved_angular_frequency_rad_per_s,radius_rad_per_s,distance_rad_per_s\n";
  for (const auto& row : judged.judgement.rows)
    table += (row.entry ? formatted("%ld", judged.list.numbers[*row.entry]) : "") + "," +
             (row.entry || !row.proved ? pair(row.listed) : ",") + "," + text(row.verdict) + "," +
             (row.proved ? pair(*row.proved) : ",") + "," +
             (row.proved ? roundedUp(row.radius, 4) : "") + "," +
             (row.proved && row.entry ? formatted("%.6e", row.distance) : "") + "\n";
  return table;
}

nlohmann::ordered_json refereeEntry(const analysis::JudgedList& judged) {
  const auto& found = judged.judgement;
  nlohmann::ordered_json entry = {
      {"sentence", found.sentence()},   {"count_proved", found.proved()},
      {"complete", found.isComplete()}, {"why_not_proved", found.why},
      {"region", found.regionText()},   {"top_rad_per_s", found.region.top}};
  if (std::isfinite(found.region.left)) entry["left_1_per_s"] = found.region.left;
  entry["eigenvalues_in_region"] = found.count.count;  // conjugates included
  entry["largest_ratio"] = found.count.ratio;
  entry["definiteness"] = found.count.definiteness;
  entry["discs"] = found.count.discs;
  entry["free_modes"] = found.sizes.modes;
  entry["basis"] = found.sizes.basis;
  entry["shift_rad2_per_s2"] = found.sizes.shift;
  entry["layout"] = judged.list.layout;
  entry["faults"] = nlohmann::ordered_json::array();
  for (const auto& row : found.rows)
    if (const auto line = lineOf(row, judged.list); !line.empty()) entry["faults"].push_back(line);
  for (const auto verdict : referee::allVerdicts)
    entry["verdicts"][referee::text(verdict)] = found.number(verdict);
  return entry;
}

std::string refereeText(const analysis::JudgedList& judged) {
  const auto& found = judged.judgement;
  const bool isJudged = found.number(referee::Verdict::right) > 0;
  std::string text = !found.isComplete() ? "\nThe list: "
                     : isJudged          ? "\nThe list is complete and right: "
                                         : "\nThe list has no eigenvalue in the region: ";
  text += found.sentence() + ".";
  for (const auto& row : found.rows)
    if (const auto line = lineOf(row, judged.list); !line.empty()) text += "\n  " + line;
  return text;
}

}  // namespace squeal::report
