// SPDX-License-Identifier: BSD-2-Clause
// What a run leaves behind: tables, summary, audit, fields.
#include <hdf5.h>

#include <numeric>
#include <regex>

#include "base/session/session.hpp"
#include "support/harness/largest_error.hpp"
#include "support/harness/same_on_ranks.hpp"
#include "support/run/layer_run.hpp"

namespace squeal::test {
namespace {

constexpr double period = 3;  // m
constexpr double pressure =
    0.01 * (1 - 0.3) / ((1 + 0.3) * (1 - 0.6));  // (λ + 2μ) times the strain, Pa

/// One run that several tests read.
const ProgramRun& layerRun() {
  static const ProgramRun run = runLayer("outputs");
  return run;
}

TEST(Outputs, Eigenvalues) {
  ASSERT_EQ(layerRun().exitCode, 0) << layerRun().error;
  const CsvTable table = readCsv(layerRun().folder / "eigenvalues.csv");
  EXPECT_EQ(table.header,
            "friction,speed,pressure,damping,mode,growth_rate_1_per_s,angular_frequency_rad_per_s,"
            "frequency_hz,damping_ratio,"
            "backward_error,error_estimate,radius_1_per_s,certified,verdict,unstable,name");
  const auto friction = table.column("friction"), mode = table.column("mode"),
             growth = table.column("growth_rate_1_per_s"),
             angular = table.column("angular_frequency_rad_per_s"),
             frequency = table.column("frequency_hz"), damping = table.column("damping_ratio"),
             error = table.column("backward_error");
  const auto estimate = table.column("error_estimate"), certified = table.column("certified");
  const auto verdict = table.words("verdict");
  const auto band = findingsOf(layerRun()).bandTop;
  EXPECT_TRUE(std::is_sorted(friction.begin(), friction.end()))
      << "begins with friction " << friction[0];
  EXPECT_EQ(friction.front(), 0);
  EXPECT_EQ(friction.back(), 0.4);
  // The band ends between two of the 21 modes, a little above 0.55 of them; without friction it
  // holds the modes below.
  const auto free = readCsv(layerRun().folder / "modes.csv").column("angular_frequency_rad_per_s");
  const auto below = std::upper_bound(free.begin(), free.end(), band.at(0)) - free.begin();
  EXPECT_GE(below, 11);
  EXPECT_LE(below, 13);
  EXPECT_EQ(std::count(friction.begin(), friction.end(), 0), below);
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const bool first = i == 0 || friction[i - 1] != friction[i];
    EXPECT_EQ(mode[i], first ? 1 : mode[i - 1] + 1);
    EXPECT_TRUE(first || frequency[i - 1] <= frequency[i]) << "row " << i + 1;
    EXPECT_LE(std::hypot(growth[i], angular[i]), band.at(friction[i]));
    EXPECT_GE(angular[i], 0);
    EXPECT_NEAR(frequency[i], angular[i] / (2 * M_PI), 1e-14 * angular[i]);
    EXPECT_NEAR(damping[i], -growth[i] / std::hypot(growth[i], angular[i]), 1e-14);
    EXPECT_GT(error[i], 0);
    EXPECT_LE(error[i], 1e-9);  // -flutter_accuracy
    EXPECT_GT(estimate[i], 0);
    EXPECT_LE(estimate[i], 1e-8);  // -flutter_tolerance
    EXPECT_EQ(certified[i], 1);
    // Without friction the problem is symmetric. With it the eigenvalues of waves that run along
    // the layer come in pairs of a growing and a decaying one.
    EXPECT_EQ(verdict[i], friction[i] == 0 ? "neutral"
                          : growth[i] > 0  ? "unstable"
                          : growth[i] < 0  ? "stable"
                                           : "neutral");
    EXPECT_EQ(growth[i] == 0, verdict[i] == "neutral");
  }
}

// The map says of each point what can be read from the eigenvalues of its band.
TEST(Outputs, StabilityMap) {
  const CsvTable map = readCsv(layerRun().folder / "stability_map.csv"),
                 all = readCsv(layerRun().folder / "eigenvalues.csv");
  EXPECT_EQ(map.header,
            "friction,speed,pressure,damping,unstable_modes,largest_growth_rate_1_per_s,frequency_"
            "hz,worst_backward_error,"
            "worst_error_estimate,verdict,undecided_modes");
  EXPECT_EQ(map.words("verdict"), (std::vector<std::string>{"neutral", "unstable", "unstable"}));
  EXPECT_EQ(map.column("undecided_modes"), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(map.column("friction"), (std::vector<double>{0, 0.2, 0.4}));
  const auto friction = all.column("friction"), growth = all.column("growth_rate_1_per_s"),
             angular = all.column("angular_frequency_rad_per_s"),
             error = all.column("backward_error");
  for (std::size_t row = 0; row < map.rows.size(); ++row) {
    double unstable = 0, largest = -INFINITY, frequency = 0, worst = 0;
    for (std::size_t i = 0; i < friction.size(); ++i) {
      if (friction[i] != map.column("friction")[row]) continue;
      unstable += growth[i] > 1e-6 * std::hypot(growth[i], angular[i]);
      if (growth[i] > largest) largest = growth[i], frequency = angular[i] / (2 * M_PI);
      worst = test::worse(worst, error[i]);
    }
    EXPECT_EQ(map.column("unstable_modes")[row], unstable);
    EXPECT_EQ(map.column("largest_growth_rate_1_per_s")[row], largest);
    EXPECT_NEAR(map.column("frequency_hz")[row], frequency, 1e-14 * frequency);
    EXPECT_EQ(map.column("worst_backward_error")[row], worst);
  }
  EXPECT_GT(map.column("unstable_modes")[2], 0);
}

TEST(Outputs, Modes) {
  const CsvTable table = readCsv(layerRun().folder / "modes.csv");
  EXPECT_EQ(table.header, "mode,angular_frequency_rad_per_s,frequency_hz,relative_residual,name");
  const auto mode = table.column("mode"), angular = table.column("angular_frequency_rad_per_s"),
             frequency = table.column("frequency_hz"), residual = table.column("relative_residual");
  ASSERT_EQ(mode.size(), 21U);
  EXPECT_TRUE(std::is_sorted(angular.begin(), angular.end()));
  const auto eigenvalues = readCsv(layerRun().folder / "eigenvalues.csv");
  const auto friction = eigenvalues.column("friction"),
             without = eigenvalues.column("frequency_hz");
  const auto first =
      static_cast<std::size_t>(std::find(friction.begin(), friction.end(), 0.0) - friction.begin());
  const auto listed = static_cast<std::size_t>(std::count(friction.begin(), friction.end(), 0.0));
  EXPECT_GE(listed, 11U);
  for (std::size_t i = 0; i < mode.size(); ++i) {
    EXPECT_EQ(mode[i], static_cast<double>(i + 1));
    EXPECT_NEAR(frequency[i], angular[i] / (2 * M_PI), 1e-14 * angular[i]);
    EXPECT_GT(angular[i], 0);
    EXPECT_LT(residual[i], 1e-6);
    if (i >= listed) continue;
    EXPECT_NEAR(without.at(first + i), frequency[i],
                1e-10 * frequency[i]);  // without friction the free modes are the answer
  }
}

TEST(Outputs, Reactions) {
  const CsvTable table = readCsv(layerRun().folder / "reactions.csv");
  EXPECT_EQ(table.header,
            "friction,speed,pressure,kind,name,force_x_n,force_y_n,force_z_n,moment_x_n_m,"
            "moment_y_n_m,moment_z_n_m");
  const auto friction = table.column("friction"), x = table.column("force_x_n"),
             y = table.column("force_y_n"), moment = table.column("moment_z_n_m");
  const auto kind = table.words("kind"), name = table.words("name");
  ASSERT_EQ(kind.size(), 3 * 4U);  // points and rows
  const double normal = pressure * period;
  for (std::size_t i = 0; i < kind.size(); i += 4) {
    EXPECT_EQ(friction[i], std::vector<double>({0, 0.2, 0.4})[i / 4]);
    EXPECT_EQ(kind[i] + " " + name[i], "support bottom");
    EXPECT_NEAR(x[i], -friction[i] * normal, 1e-9 * normal);
    EXPECT_NEAR(y[i], normal, 1e-9 * normal);
    EXPECT_EQ(kind[i + 1] + " " + name[i + 1], "interface plate");
    EXPECT_NEAR(x[i + 1], friction[i] * normal, 1e-9 * normal);
    EXPECT_NEAR(y[i + 1], -normal, 1e-9 * normal);
    EXPECT_EQ(kind[i + 2] + " " + name[i + 2], "periodic images");
    EXPECT_EQ(kind[i + 3] + name[i + 3], "sum");
    for (const double value : {x[i + 3], y[i + 3], moment[i + 3]})
      EXPECT_NEAR(value, 0, 1e-10 * normal);
  }
}

TEST(Outputs, SteadyTables) {
  for (double friction : {0.0, 0.2, 0.4}) {
    SCOPED_TRACE("friction " + shortest(friction));
    const CsvTable table = readCsv(layerRun().folder / ("steady_" + shortest(friction) + ".csv"));
    EXPECT_EQ(table.header,
              "x_m,y_m,z_m,gap_m,normal_force_n,pressure_pa,friction_force_x_n,friction_force_y_n,"
              "friction_force_z_n,interface,state");
    const auto gap = table.column("gap_m"), normal = table.column("normal_force_n"),
               local = table.column("pressure_pa"), along = table.column("friction_force_x_n");
    ASSERT_EQ(gap.size(), 12U);
    for (std::size_t i = 0; i < gap.size(); ++i) {
      EXPECT_EQ(table.rows[i].end()[-2], "plate");
      EXPECT_EQ(table.rows[i].back(), "sliding");
      EXPECT_EQ(gap[i], 0);
      EXPECT_NEAR(local[i], pressure, 1e-10 * pressure);  // uniform strain: in the elements' space
      EXPECT_NEAR(along[i], friction * normal[i], 1e-12 * pressure);
    }
    EXPECT_NEAR(std::accumulate(normal.begin(), normal.end(), 0.0), pressure * period,
                1e-10 * pressure * period);
  }
}

// The same balance where the pressure is given: the pad is held only along x.
TEST(Outputs, ContactCarriesTheLoad) {
  const ProgramRun run = runProgram(
      "outputs/loaded", 1,
      "-options_file options/two_layers.yaml -mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 5 "
      "-flutter_friction 0.3 -quiet -report_fields off"
      " -constraint_pad_top_clamped x -load_pad_top_pressure 0.02");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const CsvTable table = readCsv(run.folder / "steady_0.3.csv");
  const auto normal = table.column("normal_force_n"), along = table.column("friction_force_x_n");
  EXPECT_NEAR(std::accumulate(normal.begin(), normal.end(), 0.0), 0.02 * period,
              1e-9 * 0.02 * period);
  EXPECT_NEAR(std::accumulate(along.begin(), along.end(), 0.0), 0.3 * 0.02 * period,
              1e-9 * 0.02 * period);
  const auto steady = nlohmann::json::parse(contentOf(run.folder / "summary.json"))
                          .at("frictions")
                          .at(0)
                          .at("steady");
  EXPECT_LT(steady.at("relative_imbalance"), 1e-8);
  EXPECT_NEAR(steady.at("interfaces").at("interface").at("normal_force_n").at(1).get<double>(),
              0.02 * period,
              1e-9 * 0.02 * period);  // n points to the pad, up
}

TEST(Outputs, Summary) {
  const auto summary = nlohmann::json::parse(contentOf(layerRun().folder / "summary.json"));
  EXPECT_EQ(summary.at("version"), version());
  EXPECT_EQ(summary.at("case"), "layer");
  EXPECT_EQ(summary.at("ranks"), 2);
  EXPECT_EQ(summary.at("nodes"), 13 * 5);
  EXPECT_EQ(summary.at("contact_nodes"), 12);
  EXPECT_EQ(summary.at("dofs"),
            12 * (3 * 2 + 1));  // 12 columns of three free nodes and one on the plate
  ASSERT_EQ(summary.at("frictions").size(), 3U);
  const CsvTable table = readCsv(layerRun().folder / "eigenvalues.csv");
  const auto friction = table.column("friction"), mode = table.column("mode"),
             growth = table.column("growth_rate_1_per_s"),
             angular = table.column("angular_frequency_rad_per_s"),
             estimate = table.column("error_estimate");
  for (const auto& entry : summary.at("frictions")) {
    const auto& steady = entry.at("steady");
    EXPECT_EQ(steady.at("snes_reason").get<std::string>().rfind("CONVERGED", 0), 0U);
    EXPECT_GE(steady.at("iterations"), 0);
    EXPECT_LE(steady.at("iterations"), 6);
    EXPECT_EQ(steady.at("open_nodes"), 0);
    EXPECT_NEAR(steady.at("smallest_pressure_pa").get<double>(), pressure, 1e-9 * pressure);
    std::size_t unstable = 0;
    double worst = 0;
    for (std::size_t i = 0; i < friction.size(); ++i) {
      if (friction[i] != entry.at("friction").get<double>()) continue;
      worst = test::worse(worst, estimate[i]);
      if (growth[i] <= 1e-6 * std::hypot(growth[i], angular[i])) continue;
      ASSERT_LT(unstable, entry.at("unstable_modes").size());
      const auto& listed = entry.at("unstable_modes").at(unstable++);
      EXPECT_EQ(listed.at("mode"), mode[i]);
      EXPECT_NEAR(listed.at("growth_rate_1_per_s").get<double>(), growth[i], 1e-12 * growth[i]);
      EXPECT_NEAR(listed.at("frequency_hz").get<double>(), angular[i] / (2 * M_PI),
                  1e-12 * angular[i]);
    }
    EXPECT_EQ(unstable, entry.at("unstable_modes").size());
    EXPECT_EQ(entry.at("uncertified"), 0);
    EXPECT_EQ(entry.at("verdict"), unstable > 0 ? "unstable" : "neutral");
    EXPECT_EQ(entry.at("verdicts").at("unstable"), unstable);
    EXPECT_EQ(entry.at("verdicts").at("undecided"), 0);
    EXPECT_EQ(entry.at("tolerance_asked"), 1e-8);
    EXPECT_NEAR(entry.at("worst_error_estimate").get<double>(), worst,
                1e-3 * worst);                             // four digits in the table
    EXPECT_EQ(unstable > 0, entry.at("friction") != 0.0);  // the layer flutters at every friction
  }
  for (const char* stage :
       {"mesh", "elasticity", "contact", "steady", "modes", "flutter", "report"}) {
    EXPECT_GE(summary.at("stages").at(stage).at("wall_s"), 0) << stage;
    EXPECT_GT(summary.at("stages").at(stage).at("peak_memory_bytes"), 1e6) << stage;
    EXPECT_GE(summary.at("stages").at(stage).at("messages"), 0) << stage;
    EXPECT_GE(summary.at("stages").at(stage).at("message_bytes"),
              summary.at("stages").at(stage).at("messages"))
        << stage;
    EXPECT_GT(summary.at("stages").at(stage).at("reductions"), 0) << stage;
  }
}

TEST(Outputs, Audit) {
  EXPECT_NE(layerRun().out.find(" s  no finding (audit.md)"), std::string::npos) << layerRun().out;
  const std::string text = contentOf(layerRun().folder / "audit.md");
  for (const char* piece :
       {"# Audit of the model\n", "\nNo finding.\n", "| layer | 48 | 3 | (1.5, -0.5, 0) | 2.5 |",
        "| layer | support 'bottom': 12, interface 'plate': 12, periodic images: 10 | supported |"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
  EXPECT_NE(contentOf(layerRun().folder / "manifest.txt").find("\naudit.md\n"), std::string::npos);
}

std::vector<std::string> matches(const fs::path& file, const std::string& pattern) {
  const std::string text = contentOf(file);
  std::vector<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

TEST(Outputs, FieldsForParaView) {
  const fs::path vtk = layerRun().folder / "vtk";
  int collections = 0, grids = 0;
  std::vector<std::string> steady;
  for (const auto& entry : fs::directory_iterator(vtk)) {
    if (entry.path().extension() == ".pvd") {
      ++collections;
      const auto files = matches(entry.path(), "file=\"([^\"]+)\"");
      if (entry.path().filename() == "steady.pvd")
        steady = files;
      else
        EXPECT_GE(files.size(), 8U) << "frames of " << entry.path();
      for (const auto& file : files) EXPECT_TRUE(fs::exists(vtk / file)) << vtk / file;
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(vtk))
    if (entry.path().extension() == ".pvtu") {
      ++grids;
      const auto pieces = matches(entry.path(), "Source=\"([^\"]+)\"");
      EXPECT_EQ(pieces.size(), 2U) << entry.path();  // ranks
      for (const auto& piece : pieces)
        EXPECT_TRUE(fs::exists(entry.path().parent_path() / piece)) << piece;
    }
  EXPECT_EQ(steady.size(), 3U);
  EXPECT_GE(collections, 2);  // steady states, one mode in motion
  EXPECT_GE(grids, 3 + 1 + 2 + 16);
  for (const char* name : {"steady_friction_0.4.pvtu", "modes_from_friction_0.pvtu",
                           "complex_modes_friction_0.2.pvtu"})
    EXPECT_TRUE(fs::exists(vtk / name)) << name;
}

TEST(Outputs, Hdf5) {
  const hid_t file =
      H5Fopen((layerRun().folder / "results.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  for (const char* name : {"/mesh", "/mesh/coordinates", "/steady", "/steady/friction_0.4",
                           "/steady/friction_0.4/displacement", "/modes", "/modes/active_set_1",
                           "/modes/active_set_1/frequencies", "/flutter", "/flutter/friction_0.2",
                           "/flutter/friction_0.2/eigenvalues"})
    EXPECT_GT(H5Lexists(file, name, H5P_DEFAULT), 0) << name;
  H5Fclose(file);
}

// The direct method has no free modes: their file and fields are left out, the rest is there.
TEST(Outputs, DirectMethod) {
  const ProgramRun run = runProgram(
      "outputs/direct", 1,
      coarseLayer + "-flutter_friction 0.4 -quiet -flutter_method direct -flutter_direct_count 10");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_FALSE(fs::exists(run.folder / "modes.csv"));
  EXPECT_EQ(nlohmann::json::parse(contentOf(run.folder / "summary.json")).at("method"), "direct");
  const auto error = readCsv(run.folder / "eigenvalues.csv").column("backward_error");
  ASSERT_GE(error.size(), 10U);
  for (double e : error) EXPECT_LT(e, 1e-9);
}

// --- two ways to draw the same contact ---

TEST(Outputs, SharedInterfaceNodesGiveTheSameResults) {
  std::vector<Findings> findings;
  for (const char* shared : {"0", "1"}) {
    // 25 modes: a whole number of the pairs that periodicity makes
    const ProgramRun run =
        runProgram(std::string("outputs/shared_") + shared, 1,
                   std::string("-options_file options/two_layers.yaml -modes_count 25 "
                               "-flutter_friction 0,0.3 -quiet -report_fields off"
                               " -mesh_set nx=12,ny_disc=4,ny_pad=3,shared=") +
                       shared);
    ASSERT_EQ(run.exitCode, 0) << run.error;
    findings.push_back(findingsOf(run));
  }
  for (const char* key : {"nodes", "cells", "dofs", "contact_nodes"})
    EXPECT_EQ(findings[0].summary.at(key), findings[1].summary.at(key)) << key;
  expectSame(findings[0], findings[1], "shared interface nodes");
}

}  // namespace
}  // namespace squeal::test
