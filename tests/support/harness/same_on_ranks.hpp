// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// One case on several numbers of ranks: the partition changes the order of every sum, and nothing
/// else.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/eigen/spectrum.hpp"
#include "support/harness/largest_error.hpp"
#include "support/harness/program.hpp"

namespace squeal::test {

/// What a run found.
struct Findings {
  std::vector<double> frequencies;                     ///< free modes, rad/s
  std::map<double, std::vector<Complex>> eigenvalues;  ///< [friction]
  std::map<double, double> bandTop;   ///< [friction] rad/s: what lies above is not listed
  std::map<double, CsvTable> steady;  ///< [friction]
  nlohmann::json summary;
};

/// Of a table that has growth rates and angular frequencies.
inline std::vector<Complex> eigenvaluesOf(const CsvTable& table) {
  const auto growth = table.column("growth_rate_1_per_s"),
             angular = table.column("angular_frequency_rad_per_s");
  std::vector<Complex> list;
  for (std::size_t i = 0; i < growth.size(); ++i) list.emplace_back(growth[i], angular[i]);
  return list;
}

inline Findings findingsOf(const ProgramRun& run) {
  Findings findings;
  findings.summary = nlohmann::json::parse(contentOf(run.folder / "summary.json"));
  findings.frequencies = readCsv(run.folder / "modes.csv").column("angular_frequency_rad_per_s");
  const CsvTable table = readCsv(run.folder / "eigenvalues.csv");
  const auto friction = table.column("friction");
  const auto eigenvalues = eigenvaluesOf(table);
  for (std::size_t i = 0; i < friction.size(); ++i)
    findings.eigenvalues[friction[i]].push_back(eigenvalues[i]);
  for (const auto& entry : findings.summary.at("frictions")) {
    const double at = entry.at("friction");
    if (entry.at("steady").at("converged"))
      findings.steady[at] = readCsv(run.folder / ("steady_" + shortest(at) + ".csv"));
    findings.bandTop[at] =
        entry.contains("band_top_hz") ? 2 * M_PI * entry.at("band_top_hz").get<double>() : INFINITY;
  }
  return findings;
}

/// Normal force and friction of each contact node, found again by its place.
inline std::map<std::vector<std::string>, std::vector<double>> contactForces(
    const CsvTable& table) {
  const auto normal = table.column("normal_force_n"), x = table.column("friction_force_x_n"),
             y = table.column("friction_force_y_n"), z = table.column("friction_force_z_n");
  std::map<std::vector<std::string>, std::vector<double>> forces;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    forces[{table.rows[i].begin(), table.rows[i].begin() + 3}] = {normal[i], x[i], y[i], z[i]};
  return forces;
}

/// The largest difference of any contact force, relative to the largest force.
inline double forceDifference(const CsvTable& a, const CsvTable& b) {
  const auto left = contactForces(a), right = contactForces(b);
  if (left.size() != a.rows.size() || left.size() != right.size()) return INFINITY;
  double largest = 0, worst = 0;
  for (const auto& [place, forces] : left) {
    const auto twin = right.find(place);
    if (twin == right.end()) return INFINITY;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      largest = worse(largest, std::abs(forces[i]));
      worst = worse(worst, std::abs(forces[i] - twin->second[i]));
    }
  }
  return worst / largest;
}

inline int unstableModes(const Findings& findings, std::size_t friction) {
  return static_cast<int>(
      findings.summary.at("frictions").at(friction).at("unstable_modes").size());
}

/// What is listed at a friction lies in the band, which is the lower part of the modes and not an
/// empty one, and friction moves few eigenvalues across its top.
inline void expectBand(const Findings& findings, double friction) {
  const double top = findings.bandTop.at(friction);
  const auto& values = findings.eigenvalues.at(friction);
  const auto below = static_cast<std::size_t>(
      std::count_if(findings.frequencies.begin(), findings.frequencies.end(),
                    [&](double frequency) { return frequency <= top; }));
  EXPECT_GE(5 * below, findings.frequencies.size()) << "friction " << friction;
  EXPECT_GE(4 * values.size(), 3 * below) << "friction " << friction;
  for (const Complex s : values) EXPECT_LE(std::abs(s), top) << "friction " << friction;
}

/// Frequencies, eigenvalues, contact forces and counts of `other` are those of `one`; prints the
/// differences. SNES takes no more than `mostIterations`.
inline void expectSame(const Findings& one, const Findings& other, const std::string& label,
                       int mostIterations = 6) {
  SCOPED_TRACE(label);
  ASSERT_FALSE(one.frequencies.empty());
  ASSERT_EQ(one.frequencies.size(), other.frequencies.size());
  double frequency = 0;
  for (std::size_t i = 0; i < one.frequencies.size(); ++i)
    frequency = worse(frequency, std::abs(other.frequencies[i] / one.frequencies[i] - 1));
  EXPECT_LT(frequency, 1e-8);  // twice the digits of the modes' residuals, which are below 1e-5
  double eigenvalue = 0, force = 0;
  ASSERT_FALSE(one.eigenvalues.empty());
  ASSERT_EQ(one.eigenvalues.size(), one.steady.size());
  ASSERT_EQ(one.eigenvalues.size(), other.eigenvalues.size());
  for (const auto& [friction, values] : one.eigenvalues) {
    const auto& twins = other.eigenvalues.at(friction);
    ASSERT_EQ(values.size(), twins.size());
    expectBand(one, friction);
    EXPECT_NEAR(other.bandTop.at(friction) / one.bandTop.at(friction), 1, 1e-8);
    eigenvalue = worse(eigenvalue, worst(errors(values, twins).relative));
    force = worse(force, forceDifference(one.steady.at(friction), other.steady.at(friction)));
  }
  EXPECT_LT(eigenvalue, 1e-6);
  EXPECT_LT(force, 1e-8);  // the steady problem is solved to 1e-11
  const auto& frictions = one.summary.at("frictions");
  ASSERT_EQ(frictions.size(), other.summary.at("frictions").size());
  int iterations = 0;
  for (std::size_t i = 0; i < frictions.size(); ++i) {
    EXPECT_EQ(unstableModes(one, i), unstableModes(other, i))
        << "friction " << frictions[i].at("friction");
    for (const auto* findings : {&one, &other})
      iterations = std::max(
          iterations,
          findings->summary.at("frictions").at(i).at("steady").at("iterations").get<int>());
  }
  EXPECT_LE(iterations, mostIterations);
  std::printf(
      "%s: frequencies differ by %.1e, eigenvalues by %.1e of |s|, contact forces by %.1e of the "
      "largest; SNES iterations <= %d; "
      "unstable modes at the last friction: %d\n",
      label.c_str(), frequency, eigenvalue, force, iterations,
      unstableModes(one, frictions.size() - 1));
}

/// Returns the run of a case on a number of ranks, which is made once.
inline const ProgramRun& runOnRanks(const std::string& name, const std::string& options, int ranks,
                                    int seconds) {
  static std::map<std::string, ProgramRun> runs;
  const std::string place = "ranks/" + name + "_np" + std::to_string(ranks);
  if (const auto known = runs.find(place); known != runs.end()) return known->second;
  return runs[place] = runProgram(place, ranks, options + " -quiet -report_fields off", seconds);
}

/// Runs a case on 1, 2 and 3 ranks. `onSeveral` are the options on 2 and 3 ranks, if they differ.
inline void expectSameOnAllRanks(const std::string& name, const std::string& options, int seconds,
                                 int mostIterations = 6, const std::string& onSeveral = {}) {
  Findings one;
  for (int ranks : {1, 2, 3}) {
    const std::string label = name + " on " + std::to_string(ranks) + " ranks";
    const ProgramRun& run =
        runOnRanks(name, ranks == 1 || onSeveral.empty() ? options : onSeveral, ranks, seconds);
    ASSERT_EQ(run.exitCode, 0) << label << ": " << run.error;
    Findings findings = findingsOf(run);
    EXPECT_EQ(findings.summary.at("ranks"), ranks);
    if (ranks == 1)
      one = std::move(findings);
    else
      expectSame(one, findings, label, mostIterations);
  }
}

}  // namespace squeal::test
