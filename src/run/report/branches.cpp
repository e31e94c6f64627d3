// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/branches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"
#include "run/report/components.hpp"

namespace squeal::report {
namespace {

const char* kindName(tracking::Event::Kind kind) {
  switch (kind) {
    case tracking::Event::Kind::coalescence:
      return "coalescence";
    case tracking::Event::Kind::crossing:
      return "hopf";
    case tracking::Event::Kind::divergence:
      return "divergence";
    case tracking::Event::Kind::contact:
      return "contact";
  }
  return "";
}

/// Calls `action` for each tracked line.
template <class Action>
void forEachTrackedLine(const analysis::Analysis& analysis, const Action& action) {
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& tracked : segment.trackedLines) action(tracked);
}

/// Returns the parameters of a line that are swept or not 1, except friction, as ", speed 2".
std::string lineLabel(const sweep::Parameters& line, const std::vector<sweep::Parameter>& swept) {
  std::string label;
  for (const auto& parameter : sweep::allParameters) {
    const auto value = parameter.value;
    if (value == &sweep::Parameters::friction) continue;
    const bool isSwept =
        std::ranges::any_of(swept, [&](const auto& one) { return one.value == value; });
    if (isSwept || line.*value != 1) label += formatted(", %s %g", parameter.name, line.*value);
  }
  return label;
}

std::string parametersAt(sweep::Parameters at, double friction) {
  at.friction = friction;
  return sweep::parameterValues(at);
}

/// Returns the columns that name a critical friction.
std::string criticalColumns() {
  return "active_set,branch,partner,kind,direction," + sweep::parameterColumns() + ",frequency_hz";
}

/// Returns their values.
std::string criticalHead(const stability::TrackedLine& tracked, const stability::Critical& c) {
  return formatted("%d,%d,%d,%s,%s,", tracked.activeSet[c.piece], c.branch, c.partner,
                   kindName(c.kind), c.loss ? "loss" : "regain") +
         parametersAt(tracked.line, c.friction) +
         formatted(",%.15e", c.angularFrequency / (2 * M_PI));
}

/// Returns the numbers of the two free modes with the largest shares, and the shares, each followed
/// by a comma.
std::string largestParts(std::vector<pencil::Participation> parts) {
  std::ranges::sort(parts, std::greater{}, &pencil::Participation::energy);
  std::string text;
  for (std::size_t i = 0; i < 2; ++i)
    text += i < parts.size() ? formatted("%zu,%.6f,", parts[i].mode + 1, parts[i].energy) : ",,";
  return text;
}

}  // namespace

std::vector<std::vector<double>> branchRows(const analysis::Analysis& analysis) {
  std::vector<std::vector<double>> rows;
  forEachTrackedLine(analysis, [&](const stability::TrackedLine& tracked) {
    const auto& line = tracked.line;
    std::vector<std::vector<std::vector<double>>> ofBranch(tracked.branches.count + 1);
    for (const auto& station : tracked.branches.stations)
      for (std::size_t i = 0; i < station.pairs.size(); ++i) {
        const int branch = station.branch[i];
        if (branch == 0 || station.friction < tracked.from) continue;
        const auto s = station.pairs[i].s;
        ofBranch[branch].push_back({double(tracked.activeSet[station.piece]), double(branch),
                                    station.friction, line.speed, line.pressure, line.damping,
                                    s.real(), s.imag(), station.overlap[i],
                                    double(station.inBand[i]), station.swept ? 1.0 : 0.0});
      }
    for (auto& some : ofBranch) std::ranges::move(some, std::back_inserter(rows));
  });
  return rows;
}

std::string branchTable(const analysis::Analysis& analysis) {
  std::string table =
      "active_set,branch," + sweep::parameterColumns() +
      ",growth_rate_1_per_s,angular_frequency_rad_per_s,frequency_hz,overlap,in_band,swept\n";
  for (const auto& row : branchRows(analysis))
    table += formatted("%.0f,%.0f,", row[0], row[1]) +
             sweep::parameterValues({row[2], row[3], row[4], row[5]}) +
             formatted(",%.15e,%.15e,%.15e,%.4f,%.0f,%.0f\n", row[6], row[7], row[7] / (2 * M_PI),
                       row[8], row[9], row[10]);
  return table;
}

std::string criticalTable(const analysis::Analysis& analysis) {
  std::string table = criticalColumns() +
                      ",slope,friction_error_estimate,backward_error,converged,free_mode,"
                      "energy_share,second_free_mode,second_energy_share,name\n";
  forEachTrackedLine(analysis, [&](const stability::TrackedLine& tracked) {
    for (std::size_t i = 0; i < tracked.criticals.size(); ++i) {
      const auto& c = tracked.criticals[i];
      const auto& mode = tracked.criticalModes[i];
      table += criticalHead(tracked, c) +
               formatted(",%.6e,%.1e,%.1e,%d,", c.slope, c.errorEstimate, c.backwardError,
                         c.converged ? 1 : 0) +
               largestParts(mode.participations) + nameCell(mode.name) + "\n";
    }
  });
  return table;
}

std::string criticalSensitivityTable(const analysis::Analysis& analysis) {
  std::string table = criticalColumns() +
                      ",right_backward_error,left_backward_error,parameter,friction_derivative\n";
  forEachTrackedLine(analysis, [&](const stability::TrackedLine& tracked) {
    for (std::size_t i = 0; i < tracked.criticals.size(); ++i) {
      const auto& mode = tracked.criticalModes[i];
      const std::string head =
          criticalHead(tracked, tracked.criticals[i]) +
          (std::isnan(mode.rightBackwardError)
               ? ",,,"
               : formatted(",%.1e,%.1e,", mode.rightBackwardError, mode.leftBackwardError));
      if (mode.derivatives.empty()) table += head + "none,\n";
      for (const auto& [parameter, value] : mode.derivatives)
        table += head + parameter + formatted(",%.9e\n", value);
    }
  });
  return table;
}

std::string trackingText(const analysis::Analysis& analysis) {
  constexpr int shown = 8;
  const auto swept = sweep::sweptParameters(analysis.sweep.points());
  const double top = analysis.flutter.bandTop();
  std::string text;
  forEachTrackedLine(analysis, [&](const stability::TrackedLine& tracked) {
    const std::string line = lineLabel(tracked.line, swept);
    const auto list = [&](bool converged, const std::string& head, const auto& item,
                          const char* more) {
      int count = 0;
      for (const auto& c : tracked.criticals)
        if (c.converged == converged && ++count <= shown)
          text += (count > 1 ? ", " : head) + item(c);
      if (count > shown) text += formatted(more, count - shown);
    };
    list(
        true, "\nStability changes" + line + (line.empty() ? "" : ",") + " at friction ",
        [&](const stability::Critical& c) {
          return formatted("%.8g (%s, %.6g Hz%s%s)", c.friction, kindName(c.kind),
                           c.angularFrequency / (2 * M_PI), c.loss ? "" : ", regained",
                           c.angularFrequency > top ? ", above the band" : "");
        },
        ", and at %d more in critical.csv");
    list(
        false, "\nStability also changes" + line + ", at a friction not computed, ",
        [](const stability::Critical& c) {
          return formatted("between %.6g and %.6g (%s near %.4g Hz%s)",
                           c.friction - c.errorEstimate, c.friction + c.errorEstimate,
                           kindName(c.kind), c.angularFrequency / (2 * M_PI),
                           c.loss ? "" : ", regained");
        },
        ", and %d more in critical.csv");
    text += "\nCompleteness" + line + ": " + tracked.statement() + ".";
  });
  return text;
}

}  // namespace squeal::report
