// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/components.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "run/report/sensitivities.hpp"

namespace squeal::report {
namespace {

constexpr double leastShare = 1e-4;  // of a participation that is listed

/// Returns the participations that are listed, largest share of the energy first.
std::vector<pencil::Participation> listed(const std::vector<pencil::Participation>& all) {
  std::vector<pencil::Participation> found;
  for (const auto& one : all)
    if (std::max(one.energy, one.mac) >= leastShare) found.push_back(one);
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.energy > b.energy; });
  return found;
}

/// Returns the cells of the motion of a body, which are empty if it is unclear.
std::string motionCells(const std::string& motion, double share) {
  return motion.empty() ? "," : "\"" + motion + formatted("\",%.6f", share);
}

/// Returns the rows of one complex mode.
std::string participationRows(const std::string& head, const pencil::Shape& shape,
                              const std::vector<double>& frequencies) {
  std::string rows;
  double energy = 1, mac = 1;
  for (const auto& one : listed(shape.participations)) {
    rows += head + formatted("%zu,%.15e,%.9e,%.9e,%.9e,%.6f\n", one.mode + 1,
                             frequencies[one.mode] / (2 * M_PI), one.energy, one.mac,
                             std::abs(one.amplitude), std::arg(one.amplitude) * 180 / M_PI);
    energy -= one.energy, mac -= one.mac;
  }
  return rows + head + formatted("0,,%.9e,%.9e,,\n", energy, mac);
}

}  // namespace

std::string componentTable(const analysis::Analysis& analysis) {
  std::string table = sweep::parameterColumns() +
                      ",mode,growth_rate_1_per_s,frequency_hz,kind,component,strain_share,"
                      "kinetic_share,motion,motion_share";
  for (const auto& column : growthColumns) table += std::string(",") + column.name;
  table += "\n";
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      for (const auto& shape : point.shapes)
        for (const auto& [kind, name, strain, kinetic, motion, share, growth] : shape.components) {
          table += modeHead(point, shape) + kind + "," + name +
                   formatted(",%.15e,%.15e,", strain, kinetic) + motionCells(motion, share);
          for (const auto& column : growthColumns)
            table += formatted(",%.9e", growth.*column.value);
          table += "\n";
        }
  return table;
}

std::string modeComponentTable(const analysis::Analysis& analysis) {
  std::string table =
      "active_set,mode,frequency_hz,kind,component,strain_share,kinetic_share,motion,motion_"
      "share\n";
  const auto& segments = analysis.flutter.segments;
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (std::size_t i = 0; i < segments[s].components.size(); ++i)
      for (const auto& one : segments[s].components[i])
        table += formatted("%zu,%zu,%.15e,", s + 1, i + 1,
                           segments[s].modes.angularFrequency[i] / (2 * M_PI)) +
                 one.kind + "," + one.name + formatted(",%.15e,%.15e,", one.strain, one.kinetic) +
                 motionCells(one.motion, one.motionShare) + "\n";
  return table;
}

std::string ownModeTable(const analysis::Analysis& analysis) {
  std::string table = "body,mode,frequency_hz,motion,motion_share\n";
  const auto& bodies = analysis.flutter.ownModes;
  for (std::size_t body = 0; body < bodies.size(); ++body)
    for (std::size_t i = 0; i < bodies[body].size(); ++i) {
      const auto& [frequency, motion] = bodies[body][i];
      table += analysis.model.mesh->bodies[body] +
               formatted(",%zu,%.15e,", i + 1, frequency / (2 * M_PI)) +
               motionCells(motion.name, motion.share) + "\n";
    }
  return table;
}

std::string participationTable(const analysis::Analysis& analysis) {
  std::string table = sweep::parameterColumns() +
                      ",mode,growth_rate_1_per_s,frequency_hz,free_mode,free_frequency_hz,energy_"
                      "share,mac,amplitude,phase_deg\n";
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      for (const auto& shape : point.shapes)
        if (!shape.participations.empty())
          table += participationRows(modeHead(point, shape), shape, segment.modes.angularFrequency);
  return table;
}

std::string bodyMacTable(const analysis::Analysis& analysis) {
  std::string table =
      sweep::parameterColumns() +
      ",mode,growth_rate_1_per_s,frequency_hz,free_mode,free_frequency_hz,body,mac\n";
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      for (const auto& shape : point.shapes)
        for (const auto& [mode, mac] : shape.correlations)
          for (std::size_t body = 0; body < mac.size(); ++body)
            table += modeHead(point, shape) +
                     formatted("%zu,%.15e,", mode + 1,
                               segment.modes.angularFrequency[mode] / (2 * M_PI)) +
                     analysis.model.mesh->bodies[body] + formatted(",%.9e\n", mac[body]);
  return table;
}

std::string nameCell(const std::string& name) { return name.empty() ? "" : "\"" + name + "\""; }

}  // namespace squeal::report
