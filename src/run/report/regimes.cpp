// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/regimes.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"
#include "run/report/report.hpp"

namespace squeal::report {
namespace {

/// Calls action(study, run, head) for each run, with the first cells of its rows.
template <class Action>
void forEachRun(const analysis::Analysis& analysis, const Action& action) {
  for (const auto& study : analysis.flutter.regimes)
    for (const auto& run : study.runs)
      action(study, run, sweep::parameterValues(study.at) + "," + run.start);
}

std::string head(const std::string& rest) {
  return sweep::parameterColumns() + ",start" + rest + "\n";
}

std::string onsetTable(const analysis::Analysis& analysis) {
  std::string table = sweep::parameterColumns() +
                      ",mode,growth_rate_1_per_s,frequency_hz,event,x_m,y_m,z_m,interface,kinetic_"
                      "energy_j,turning\n";
  for (const auto& mode : analysis.flutter.onsets) {
    table += sweep::parameterValues(mode.at) + formatted(",%zu,%.15e,%.15e,%s", mode.mode + 1,
                                                         mode.s.real(), mode.s.imag() / (2 * M_PI),
                                                         text(mode.onset.event));
    if (mode.onset.event == march::OnsetEvent::none)
      table += ",,,,,,\n";
    else
      table += formatted(",%.12e,%.12e,%.12e,%s,%.9e,%.6e\n", mode.position[0], mode.position[1],
                         mode.position[2],
                         analysis.model.contact.interfaces.names[mode.interface].c_str(),
                         mode.kinetic, mode.onset.turning);
  }
  return table;
}

std::string cell(double value) { return std::isfinite(value) ? formatted(",%.9e", value) : ","; }

std::string soundCells(const sound::Sound& sound) {
  return cell(sound.meanSquareVelocity) + cell(sound.area) + cell(sound.power) + cell(sound.level);
}

std::string regimeTable(const analysis::Analysis& analysis) {
  std::string table = head(
      ",class,settled,duration_s,step_s,carrier_hz,flutter_frequency_hz,modulation_hz,growth_rate_"
      "1_per_s,certified_growth_rate_1_per_s,largest_kinetic_energy_j,mean_kinetic_energy_j,peak_"
      "deviation,largest_slip_velocity_m_per_s,largest_gap_change_m,friction_coefficient,friction_"
      "power_w,steady_friction_power_w,open_nodes,sticking_nodes,contact_nodes,onset_kinetic_"
      "energy_j,largest_defect,energy_imbalance,model_error,mean_square_velocity_m2_per_s2,"
      "radiating_"
      "area_m2,sound_power_estimate_w,sound_power_level_db");
  forEachRun(analysis, [&](const auto& study, const auto& run, const std::string& first) {
    const regime::Regime& regime = run.regime;
    // A march without measurements has no figures.
    const auto measured = [&](double value) { return cell(regime.measured() ? value : NAN); };
    const auto size =
        study.nodes.empty() ? std::string(",") : formatted(",%zu", study.nodes.size());
    table += first + "," + text(regime.kind) + (regime.settled ? ",1" : ",0") +
             measured(regime.duration) + cell(run.step) +
             measured(regime.carrier > 0 ? regime.carrier : NAN) + cell(run.s.imag() / (2 * M_PI)) +
             measured(regime.modulation > 0 ? regime.modulation : NAN) + measured(regime.growth) +
             cell(run.s.real()) + measured(regime.largestKinetic) + measured(regime.means.kinetic) +
             measured(regime.peakDeviation) + measured(regime.largestVelocity) +
             measured(regime.largestJump) + measured(regime.means.frictionCoefficient) +
             measured(regime.means.frictionPower) + cell(study.steadyPower) +
             measured(regime.means.open) + measured(regime.means.sticking) + size +
             cell(run.onsetKinetic) + measured(regime.largestDefect) + measured(regime.imbalance) +
             cell(study.modelError) + soundCells(run.surface.sound) + "\n";
  });
  return table;
}

std::string nodeTable(const analysis::Analysis& analysis) {
  std::string table = head(
      ",x_m,y_m,z_m,interface,open,stick,slip,mean_pressure_pa,largest_gap_m,friction_power_w");
  forEachRun(analysis, [&](const auto& study, const auto& run, const std::string& first) {
    for (std::size_t i = 0; i < run.regime.nodes.size(); ++i) {
      const auto& x = study.nodes[i].position;
      const auto& means = run.regime.nodes[i];
      table += first +
               formatted(",%.12e,%.12e,%.12e,%s,%.6f,%.6f,%.6f,%.9e,%.9e,%.9e\n", x[0], x[1], x[2],
                         analysis.model.contact.interfaces.names[study.nodes[i].interface].c_str(),
                         means.open, means.stick, means.slip, means.pressure, means.largestGap,
                         means.power);
    }
  });
  return table;
}

std::string cycleTable(const analysis::Analysis& analysis) {
  std::string table = head(",cycle,time_s,largest_kinetic_energy_j");
  forEachRun(analysis, [&](const auto&, const auto& run, const std::string& first) {
    const double period = 2 * M_PI / run.s.imag();
    for (std::size_t i = 0; i < run.regime.cyclePeaks.size(); ++i)
      table +=
          first + formatted(",%zu,%.9e,%.9e\n", i + 1, (i + 1) * period, run.regime.cyclePeaks[i]);
  });
  return table;
}

/// Returns the names of the columns of the points, the same number for all runs.
std::string pointColumns(const analysis::Analysis& analysis) {
  std::size_t count = 0;
  forEachRun(analysis, [&](const auto&, const auto& run, const std::string&) {
    count = std::max(count, run.surface.points.size());
  });
  std::string columns;
  for (std::size_t k = 1; k <= count; ++k)
    for (const char* component : {"x", "y", "z", "normal"})
      columns += formatted(",velocity_%zu_%s_m_per_s", k, component);
  return columns;
}

std::string spectrumTable(const analysis::Analysis& analysis) {
  std::string table = head(",frequency_hz,velocity_sqrt_kg_m_per_s" + pointColumns(analysis));
  forEachRun(analysis, [&](const auto&, const auto& run, const std::string& first) {
    const auto& lines = run.regime.spectrum;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      table += first + formatted(",%.9e,%.9e", lines[i].frequency, lines[i].whole);
      for (const auto& point : run.surface.points)
        for (const double value : point.amplitude.at(i)) table += formatted(",%.9e", value);
      table += "\n";
    }
  });
  return table;
}

std::string pointTable(const analysis::Analysis& analysis) {
  std::string table =
      head(",point,name,x_m,y_m,z_m,normal_x,normal_y,normal_z,mean_square_velocity_m2_per_s2");
  forEachRun(analysis, [&](const auto&, const auto& run, const std::string& first) {
    std::size_t number = 0;
    for (const auto& point : run.surface.points) {
      table += first + formatted(",%zu,%s", ++number, point.name.c_str());
      for (const double x : point.position) table += formatted(",%.12e", x);
      for (const double n : point.normal) table += formatted(",%.9f", n);
      table += cell(point.meanSquareVelocity) + "\n";
    }
  });
  return table;
}

std::string periodicTable(const analysis::Analysis& analysis) {
  std::string table = head(
      ",motion,motion_friction,converged,frequency_hz,change,largest_kinetic_energy_j,friction_"
      "coefficient,friction_power_w,opening_nodes,sticking_nodes,trivial_multiplier,largest_"
      "multiplier,stable");
  forEachRun(analysis, [&](const auto&, const auto& run, const std::string& first) {
    int number = 0;
    for (const auto& motion : run.cycles.motions) {
      table += first + formatted(",%d,%.12e,%d,%.12e,%.3e", ++number, motion.friction,
                                 motion.converged ? 1 : 0, 1 / motion.period, motion.change);
      const auto& measures = motion.measures;
      table +=
          formatted(",%.9e,%.9e,%.9e,%d,%d", measures.largestKinetic, measures.frictionCoefficient,
                    measures.frictionPower, measures.opening, measures.sticking);
      table += motion.converged
                   ? formatted(",%.9e,%.9e,%d\n", std::abs(motion.trivialMultiplier()),
                               std::abs(motion.largestMultiplier()), motion.stable() ? 1 : 0)
                   : ",,,\n";
    }
  });
  return table;
}

/// Returns a row for each fold of a branch, and one row for a branch without folds.
std::string branchTable(const analysis::Analysis& analysis) {
  std::string table = head(",towards,fold_friction,end_friction,reason");
  forEachRun(analysis, [&](const auto&, const auto& run, const std::string& first) {
    const auto& routes = run.cycles.routes;
    for (std::size_t i = 0; i < routes.size(); ++i) {
      auto folds = routes[i].folds;
      if (folds.empty()) folds.push_back(NAN);
      for (const double fold : folds)
        table += first + (i == 0 ? ",smaller" : ",larger") + cell(fold) + cell(routes[i].end) +
                 "," + routes[i].reason + "\n";
    }
  });
  return table;
}

std::string floquetTable(const analysis::Analysis& analysis) {
  std::string table = head(
      ",motion,motion_friction,real,imaginary,modulus,frequency_hz,growth_rate_1_per_s,trivial");
  forEachRun(analysis, [&](const auto&, const auto& run, const std::string& first) {
    int number = 0;
    for (const auto& motion : run.cycles.motions) {
      ++number;
      for (std::size_t i = 0; i < motion.multipliers.values.size(); ++i) {
        const Complex m = motion.multipliers.values[i], rate = std::log(m) / motion.period;
        table +=
            first + formatted(",%d,%.12e,%.9e,%.9e,%.9e,%.9e,%.9e,%d\n", number, motion.friction,
                              m.real(), m.imag(), std::abs(m), rate.imag() / (2 * M_PI),
                              rate.real(), i == motion.multipliers.trivial);
      }
    }
  });
  return table;
}

}  // namespace

void writeRegimes(const analysis::Analysis& analysis, const std::filesystem::path& folder) {
  const MPI_Comm comm = analysis.comm;
  if (!analysis.flutter.onsets.empty()) writeText(comm, folder / "onset.csv", onsetTable(analysis));
  if (analysis.flutter.regimes.empty()) return;
  writeText(comm, folder / "regime.csv", regimeTable(analysis));
  writeText(comm, folder / "regime_nodes.csv", nodeTable(analysis));
  writeText(comm, folder / "regime_cycles.csv", cycleTable(analysis));
  writeText(comm, folder / "regime_spectrum.csv", spectrumTable(analysis));
  writeText(comm, folder / "regime_points.csv", pointTable(analysis));
  const auto& cycles = analysis.settings.regime.cycles;
  if (!cycles.wanted) return;
  writeText(comm, folder / "periodic.csv", periodicTable(analysis));
  writeText(comm, folder / "floquet.csv", floquetTable(analysis));
  if (cycles.range) writeText(comm, folder / "periodic_branch.csv", branchTable(analysis));
}

}  // namespace squeal::report
