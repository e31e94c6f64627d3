// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/proofs.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"
#include "run/report/components.hpp"

namespace squeal::report {
namespace {

/// Returns the points with a proof or the attempt of one.
std::vector<const pencil::ComplexModes*> examined(const analysis::Analysis& analysis) {
  std::vector<const pencil::ComplexModes*> points;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      if (point.completeness) points.push_back(&point);
  return points;
}

/// Returns the reason why the number or the place of an eigenvalue is not proved.
std::string reasonOf(const pencil::ComplexModes& point) {
  const auto& found = *point.completeness;
  if (!found.reason.empty() || point.withoutDisc() == 0) return found.reason;
  return formatted("the number of eigenvalues is proved; %d of them have no disc of their own",
                   point.withoutDisc());
}

}  // namespace

bool hasProofs(const analysis::Analysis& analysis) { return !examined(analysis).empty(); }

std::string proofTable(const analysis::Analysis& analysis) {
  std::string table = sweep::parameterColumns() +
                      ",complete,count_proved,eigenvalues,top_hz,left_1_per_s,ratio,definiteness,"
                      "discs,without_disc,missing,"
                      "spurious,undecided,reason\n";
  for (const auto* point : examined(analysis)) {
    const auto& found = *point->completeness;
    table += sweep::parameterValues(point->at) +
             formatted(",%d,%d,%g,%.15e,", point->listIsProved() ? 1 : 0, found.proved ? 1 : 0,
                       found.pairs(), found.top / (2 * M_PI)) +
             (std::isfinite(found.left) ? formatted("%.15e", found.left) : "") +
             formatted(",%.6e,%.6e,%d,%d,%zu,%zu,%zu,", found.ratio, found.definiteness,
                       found.discs, point->withoutDisc(), found.missing.size(),
                       found.spurious.size(), found.undecided.size()) +
             nameCell(reasonOf(*point)) + "\n";
  }
  return table;
}

nlohmann::json proofEntry(const pencil::ComplexModes& point) {
  const auto& found = *point.completeness;
  nlohmann::json entry = {{"complete", point.listIsProved()},
                          {"count_proved", found.proved},
                          {"eigenvalues", found.pairs()},
                          {"top_hz", found.top / (2 * M_PI)},
                          {"left_1_per_s", nullptr},
                          {"ratio", found.ratio},
                          {"definiteness", found.definiteness},
                          {"discs", found.discs},
                          {"without_disc", point.withoutDisc()},
                          {"reason", reasonOf(point)},
                          {"missing", nlohmann::json::array()},
                          {"spurious", nlohmann::json::array()},
                          {"undecided", nlohmann::json::array()}};
  if (std::isfinite(found.left)) entry["left_1_per_s"] = found.left;
  for (const auto& one : found.missing)
    entry["missing"].push_back({{"growth_rate_1_per_s", one.centre.real()},
                                {"angular_frequency_rad_per_s", one.centre.imag()},
                                {"radius_1_per_s", one.radius}});
  for (const auto& [name, list] :
       {std::pair("spurious", &found.spurious), std::pair("undecided", &found.undecided)})
    for (const auto s : *list)
      entry[name].push_back(
          {{"growth_rate_1_per_s", s.real()}, {"angular_frequency_rad_per_s", s.imag()}});
  return entry;
}

std::string proofText(const analysis::Analysis& analysis) {
  const auto points = examined(analysis);
  if (points.empty()) return {};
  double ratio = 0, radius = 0, top = INFINITY, left = INFINITY;
  std::size_t complete = 0, beyond = 0;
  std::string others;
  for (const auto* point : points) {
    const auto& found = *point->completeness;
    const std::string at = sweep::parameterText(point->at);
    for (const auto& one : found.missing)
      others += formatted(
          "\nMissing in the list at %s: one eigenvalue within %s 1/s of "
          "%.9g%+.9gi 1/s.",
          at.c_str(), roundedUp(one.radius, 2).c_str(), one.centre.real(), one.centre.imag());
    for (const auto s : found.spurious)
      others += formatted("\nWrong in the list at %s: %.9g%+.9gi 1/s is not an eigenvalue.",
                          at.c_str(), s.real(), s.imag());
    for (const auto s : found.undecided)
      others +=
          formatted("\nUndecided at %s: an eigenvalue near %.9g%+.9gi 1/s that is not in the list.",
                    at.c_str(), s.real(), s.imag());
    if (!found.proved)
      others += "\nNot proved at " + at + ": " + found.reason + ".";
    else if (point->withoutDisc() > 0)
      others += "\nAt " + at + ": " + reasonOf(*point) + ".";
    if (!point->listIsProved()) continue;
    ++complete;
    ratio = std::max(ratio, found.ratio);
    top = std::min(top, point->bandTop / (2 * M_PI));
    left = std::min(left, found.left);
    for (const auto& e : point->eigenvalues) {
      if (e.s.real() > -found.left)
        radius = std::max(radius, e.radius);
      else
        ++beyond;
    }
  }
  std::string text =
      formatted("\nProof: the list is complete at %zu of %zu points", complete, points.size());
  if (complete > 0)
    text += ": the full problem has no other eigenvalue with |s|/2π up to " + roundedDown(top, 6) +
            " Hz" +
            (std::isfinite(left) ? " and Re s > -" + roundedDown(left, 4) + "/s in the band" : "") +
            ", and exactly one within " + roundedUp(radius, 2) + " 1/s of each" +
            (beyond > 0 ? formatted(" except %zu that decay faster", beyond) : "") +
            formatted(" (largest ratio %.2g; round-off is not bounded)", ratio);
  return text + "." + others;
}

}  // namespace squeal::report
