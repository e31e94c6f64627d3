#include "report/regimes.hpp"

#include <algorithm>
#include <cmath>

#include "petsc/text.hpp"
#include "report/report.hpp"
#include "sweep/parameters.hpp"

namespace squeal::report {
namespace {

/// Calls action(study, run, head) for each run, with the first cells of its rows.
template <class Action>
void forEachRun(const analysis::Analysis& analysis, const Action& action) {
  for (const auto& study : analysis.regimes)
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
  for (const auto& mode : analysis.onsets) {
    table += sweep::parameterValues(mode.at) + formatted(",%zu,%.15e,%.15e,%s", mode.mode + 1,
                                                         mode.s.real(), mode.s.imag() / (2 * M_PI),
                                                         text(mode.onset.event));
    if (mode.onset.event == regime::Event::none)
      table += ",,,,,,\n";
    else
      table += formatted(",%.12e,%.12e,%.12e,%s,%.9e,%.6e\n", mode.position[0], mode.position[1],
                         mode.position[2], analysis.contact.interfaces[mode.interface].c_str(),
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
    const bool averaged = !regime.nodes.empty();  // a whole window at least
    const auto mean = [&](double value) { return cell(averaged ? value : NAN); };
    table += first + formatted(",%s,%d", text(regime.kind), regime.settled ? 1 : 0) +
             cell(regime.duration) + cell(study.step) +
             cell(regime.carrier > 0 ? regime.carrier : NAN) + cell(run.s.imag() / (2 * M_PI)) +
             cell(regime.modulation > 0 ? regime.modulation : NAN) + cell(regime.growth) +
             cell(run.s.real()) + mean(regime.largestKinetic) + mean(regime.means.kinetic) +
             mean(regime.peakDeviation) + mean(regime.largestVelocity) + mean(regime.largestJump) +
             mean(regime.means.frictionCoefficient) + mean(regime.means.frictionPower) +
             cell(study.steadyPower) + mean(regime.means.open) + mean(regime.means.sticking) +
             formatted(",%zu", study.nodes.size()) + cell(run.onsetKinetic) +
             cell(regime.largestDefect) + cell(regime.imbalance) + cell(study.modelError) +
             soundCells(run.outside.sound) + "\n";
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
                         analysis.contact.interfaces[study.nodes[i].interface].c_str(), means.open,
                         means.stick, means.slip, means.pressure, means.largestGap, means.power);
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

/// Returns the names of the columns of the points; all runs have as many.
std::string pointColumns(const analysis::Analysis& analysis) {
  std::size_t count = 0;
  forEachRun(analysis, [&](const auto&, const auto& run, const std::string&) {
    count = std::max(count, run.outside.points.size());
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
      for (const auto& point : run.outside.points)
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
    for (const auto& point : run.outside.points) {
      table += first + formatted(",%zu,%s", ++number, point.name.c_str());
      for (const double x : point.position) table += formatted(",%.12e", x);
      for (const double n : point.normal) table += formatted(",%.9f", n);
      table += cell(point.meanSquareVelocity) + "\n";
    }
  });
  return table;
}

}  // namespace

void writeRegimes(const analysis::Analysis& analysis, const std::filesystem::path& folder) {
  const MPI_Comm comm = analysis.comm;
  if (!analysis.onsets.empty()) writeText(comm, folder / "onset.csv", onsetTable(analysis));
  if (analysis.regimes.empty()) return;
  writeText(comm, folder / "regime.csv", regimeTable(analysis));
  writeText(comm, folder / "regime_nodes.csv", nodeTable(analysis));
  writeText(comm, folder / "regime_cycles.csv", cycleTable(analysis));
  writeText(comm, folder / "regime_spectrum.csv", spectrumTable(analysis));
  writeText(comm, folder / "regime_points.csv", pointTable(analysis));
}

}  // namespace squeal::report
