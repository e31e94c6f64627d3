// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "base/session/session.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/text.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/sensitivity/settings.hpp"
#include "eigen/sweep/parameters.hpp"
#include "run/analysis/contact_path.hpp"
#include "run/report/branches.hpp"
#include "run/report/components.hpp"
#include "run/report/judgement.hpp"
#include "run/report/names.hpp"
#include "run/report/proofs.hpp"
#include "run/report/reactions.hpp"
#include "run/report/regimes.hpp"
#include "run/report/report.hpp"
#include "run/report/sensitivities.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::report {
namespace {

std::string eigenvalueTable(const analysis::Analysis& analysis) {
  std::string table =
      sweep::parameterColumns() +
      ",mode,growth_rate_1_per_s,angular_frequency_rad_per_s,frequency_hz,damping_"
      "ratio,backward_error,error_estimate,radius_1_per_s,certified,verdict,unstable,name\n";
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points) {
      std::vector<std::string> names(point.eigenvalues.size());
      for (const auto& shape : point.shapes) names[shape.index] = modeName(shape.components);
      for (std::size_t i = 0; i < point.eigenvalues.size(); ++i) {
        const auto& e = point.eigenvalues[i];
        table += sweep::parameterValues(point.at) + "," + std::to_string(i + 1) +
                 formatted(",%.15e,%.15e,%.15e,%.15e,%.3e,%.3e,", e.s.real(), e.s.imag(),
                           e.s.imag() / (2 * M_PI), e.dampingRatio(), e.backwardError,
                           e.errorEstimate()) +
                 (std::isfinite(e.radius) ? roundedUp(e.radius, 4) : "") +
                 formatted(",%d,%s,%d,", e.certified ? 1 : 0, text(e.verdict), e.unstable ? 1 : 0) +
                 nameCell(names[i]) + "\n";
      }
    }
  return table;
}

/// Returns a table with a row for each point of the sweep. A cell is empty if there is no steady
/// sliding, no eigenvalue or no estimate.
std::string stabilityMap(const analysis::Analysis& analysis) {
  const auto cell = [](const char* format, double value) {
    char text[32] = "";
    if (std::isfinite(value)) std::snprintf(text, sizeof text, format, value);
    return "," + std::string(text);
  };
  std::string table = sweep::parameterColumns() +
                      ",unstable_modes,largest_growth_rate_1_per_s,frequency_hz,worst_backward_"
                      "error,worst_error_estimate,verdict,undecided_modes\n";
  for (const auto& at : analysis.sweep.points()) {
    const auto* point = analysis.pointAt(at);
    const auto* fastest = point ? point->fastestGrowing() : nullptr;
    table += sweep::parameterValues(at) + cell("%.0f", point ? point->unstableCount() : NAN) +
             cell("%.15e", fastest ? fastest->s.real() : NAN) +
             cell("%.15e", fastest ? fastest->s.imag() / (2 * M_PI) : NAN) +
             cell("%.3e", fastest ? point->worstBackwardError() : NAN) +
             cell("%.3e", fastest ? point->worstErrorEstimate() : NAN) + "," +
             (point ? text(point->verdict()) : "") +
             cell("%.0f", point ? point->count(pencil::Verdict::undecided) : NAN) + "\n";
  }
  return table;
}

std::string modeTable(const sweep_solver::ModalSegment& segment) {
  const modes::Modes& modes = segment.modes;
  std::string table = "mode,angular_frequency_rad_per_s,frequency_hz,relative_residual,name\n";
  for (std::size_t i = 0; i < modes.angularFrequency.size(); ++i)
    table += formatted("%zu,%.15e,%.15e,%.3e,", i + 1, modes.angularFrequency[i],
                       modes.angularFrequency[i] / (2 * M_PI), modes.relativeResidual[i]) +
             (i < segment.components.size() ? nameCell(modeName(segment.components[i])) : "") +
             "\n";
  return table;
}

/// Returns the state of a contact node as one word.
std::string nodeState(const contact::Contact& contact, const steady::Solution& solution,
                      std::size_t i) {
  if (!solution.closed[i]) return "open";
  if (contact.interfaces.nodes[i].role != contact::Role::sticking)
    return interfaces::text(contact.interfaces.nodes[i].role);
  if (solution.sticking.holds[i] == steady::Hold::released) return "released";
  if (solution.sticking.holds[i] == steady::Hold::open) return "unheld";
  return steady::exceedsLimit(contact, solution, i) ? "beyond_friction" : "sticking";
}

std::string gathered(MPI_Comm comm, const std::string& text) {
  const auto all = concatenatedOnFirst<char>(comm, text);
  return {all.begin(), all.end()};
}

/// Returns the rows of this rank, which rank 0 gathers.
std::string steadyRows(const analysis::Analysis& analysis, const steady::Solution& solution) {
  std::string rows;
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& p = analysis.model.contact.interfaces.nodes[i].position;
    const auto& state = solution.contact[i];
    rows += formatted("%.12e,%.12e,%.12e,%.12e,%.12e,%.12e,%.12e,%.12e,%.12e,", p[0], p[1], p[2],
                      state.gap, state.normalForce, state.pressure, state.frictionForce[0],
                      state.frictionForce[1], state.frictionForce[2]) +
            analysis.model.contact.interfaces
                .names[analysis.model.contact.interfaces.nodes[i].interface] +
            "," + nodeState(analysis.model.contact, solution, i) + "\n";
  }
  return rows;
}

/// Collective. Returns the table of the changes of contact nodes.
std::string contactPathTable(const analysis::Analysis& analysis) {
  std::string table = "friction,speed,pressure,x_m,y_m,z_m,interface,change\n";
  for (const auto& [order, at, x, interface, change] : analysis::contactPath(analysis))
    table += formatted("%.12g,%.12g,%.12g,%.12e,%.12e,%.12e,", at.friction, at.speed, at.pressure,
                       x[0], x[1], x[2]) +
             analysis.model.contact.interfaces.names[interface] + "," + condensed::text(change) +
             "\n";
  return table;
}

}  // namespace

void writeTables(const analysis::Analysis& analysis, const std::filesystem::path& folder) {
  const MPI_Comm comm = analysis.comm;
  writeText(comm, folder / "eigenvalues.csv", eigenvalueTable(analysis));
  if (analysis.judged) writeText(comm, folder / "referee.csv", refereeTable(*analysis.judged));
  if (analysis.settings.solver.sensitivity.wanted) {
    const std::string table = sensitivityTable(analysis);
    writeText(comm, folder / "sensitivities.csv", table);
    if (std::ranges::count(table, '\n') == 1)
      printLine(comm, "sensitivities.csv has no rows, since no mode was found unstable");
  }
  if (analysis.model.mesh) {
    writeText(comm, folder / "friction_work.csv", frictionWorkTable(analysis));
    writeText(comm, folder / "components.csv", componentTable(analysis));
    writeText(comm, folder / "mode_components.csv", modeComponentTable(analysis));
    writeText(comm, folder / "participation_bodies.csv", bodyMacTable(analysis));
    if (analysis.settings.mesh->ownModes > 0)
      writeText(comm, folder / "component_modes.csv", ownModeTable(analysis));
    writeText(comm, folder / "reactions.csv", reactionTable(analysis));
  }
  writeText(comm, folder / "participation.csv", participationTable(analysis));
  writeText(comm, folder / "stability_map.csv", stabilityMap(analysis));
  if (std::any_of(analysis.flutter.segments.begin(), analysis.flutter.segments.end(),
                  [](const auto& segment) { return !segment.trackedLines.empty(); })) {
    writeText(comm, folder / "branches.csv", branchTable(analysis));
    writeText(comm, folder / "critical.csv", criticalTable(analysis));
    if (analysis.settings.solver.sensitivity.wanted)
      writeText(comm, folder / "critical_sensitivities.csv", criticalSensitivityTable(analysis));
  }
  for (std::size_t s = 0; s < analysis.flutter.segments.size(); ++s) {
    if (analysis.flutter.segments[s].modes.angularFrequency.empty()) continue;
    // modes.csv: the first active set; each later one has its own file, named by its first point.
    const std::string name =
        s == 0 ? "modes.csv"
               : "modes_" + pointName(analysis.flutter.segments[s].points.at(0).at) + ".csv";
    writeText(comm, folder / name, modeTable(analysis.flutter.segments[s]));
  }
  if (hasProofs(analysis)) writeText(comm, folder / "proof.csv", proofTable(analysis));
  writeRegimes(analysis, folder);
  if (analysis.steady.events > 0)
    writeText(comm, folder / "contact_path.csv", contactPathTable(analysis));
  for (const auto& solution : analysis.steady.solutions)
    if (solution.converged)
      writeText(comm, folder / ("steady_" + pointName(solution.at) + ".csv"),
                "x_m,y_m,z_m,gap_m,normal_force_n,pressure_pa,friction_force_x_n,friction_force_y_"
                "n,friction_force_z_n,interface,state\n" +
                    gathered(comm, steadyRows(analysis, solution)));
}

}  // namespace squeal::report
