// SPDX-License-Identifier: BSD-2-Clause
// What a run leaves of the motion after flutter beside the contact: sound, spectra at points,
// fields and an animation; on 1 and 2 ranks, of which the last writes into the folder of the first.
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "support/harness/hdf5_reader.hpp"
#include "support/harness/vtu_reader.hpp"
#include "support/regime/regime_cases.hpp"

namespace squeal::test {
namespace {

/// The start is a tenth of the onset, so that all is linear; two points, beside the whole.
const Options linear =
    with(without(coarse, {"report_fields"}), {{"regime_time", "0.008"},
                                              {"regime_start_factor", "0.1"},
                                              {"regime_frames", "4"},
                                              {"regime_cycles_kept", "3"},
                                              {"regime_spectrum_points", "0.15,0,0; -0.15,0,0"}});

struct Left {
  CsvTable regime, spectrum, points, nodes;
  fs::path folder;
};

Left leftBy(const ProgramRun& run) {
  EXPECT_EQ(run.exitCode, 0) << run.error;
  const auto table = [&](const std::string& name) { return readCsv(run.folder / (name + ".csv")); };
  return {table("regime"), table("regime_spectrum"), table("regime_points"), table("regime_nodes"),
          run.folder};
}

/// The largest entry of a nodal field, and the number of those that are not zero. The pieces of two
/// ranks both have the points that they share, which count once.
std::pair<double, int> largestOf(vtkUnstructuredGrid& grid, const char* name) {
  auto* values = grid.GetPointData()->GetArray(name);
  std::pair<double, int> result{0, 0};
  if (!values) return result;
  std::set<std::array<double, 4>> places;  // of those that are not zero
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    for (int d = 0; d < values->GetNumberOfComponents(); ++d) {
      result.first = std::max(result.first, std::abs(values->GetComponent(i, d)));
      const double* at = grid.GetPoint(i);
      if (values->GetComponent(i, d) != 0) places.insert({at[0], at[1], at[2], double(d)});
    }
  result.second = std::ssize(places);
  return result;
}

void checkSound(const CsvTable& regime) {
  const double area = valueOf(regime, "radiating_area_m2"),
               square = valueOf(regime, "mean_square_velocity_m2_per_s2"),
               power = valueOf(regime, "sound_power_estimate_w");
  EXPECT_NEAR(power / (415 * area * square), 1, 1e-8);
  EXPECT_NEAR(valueOf(regime, "sound_power_level_db"), 10 * std::log10(power) + 120, 1e-6);
}

void checkSpectrum(const Left& left) {
  EXPECT_EQ(left.points.words("name"), (std::vector<std::string>{"1", "2"}));
  const auto frequency = left.spectrum.column("frequency_hz");
  const auto strongest = [&](const std::string& column) {
    const auto values = left.spectrum.column(column);
    return frequency[std::max_element(values.begin(), values.end()) - values.begin()];
  };
  for (const std::string column :
       {"velocity_sqrt_kg_m_per_s", "velocity_1_z_m_per_s", "velocity_2_z_m_per_s"})
    EXPECT_NEAR(strongest(column) / valueOf(left.regime, "flutter_frequency_hz"), 1, 0.02);
  // By Parseval's theorem the squares of a Hann window's lines sum up to 3/2 of twice the mean
  // square; the window weighs a motion that grows otherwise, by less than its growth.
  double sum = 0;
  for (const char* d : {"x", "y", "z"})
    for (const double a : left.spectrum.column(std::string("velocity_1_") + d + "_m_per_s"))
      sum += a * a / 3;
  EXPECT_NEAR(sum / left.points.column("mean_square_velocity_m2_per_s2").at(0), 1, 0.7);
}

/// The frames are the latest periods; gaps and pressures are there at the 45 contact nodes.
void checkFields(const Left& left) {
  const std::string start = left.regime.words("start").at(0), name = "friction_0.4_start_" + start;
  const auto vtk = left.folder / "vtk";
  double largest[13];
  for (int k = 0; k < 13; ++k) {
    const auto grid = readVtu(vtk / ("regime_" + name) / (formatted("frame_%03d", k) + ".pvtu"));
    largest[k] = largestOf(*grid, "displacement").first;
    EXPECT_EQ(largestOf(*grid, "contact_pressure").second, 45);
    EXPECT_LT(largestOf(*grid, "gap").first, 1e-3 * largest[k]);  // all are closed
  }
  // A period later the same shape comes back, larger by its growth; a frame lies up to a step of a
  // 128th of the period late.
  const double growth = std::exp(valueOf(left.regime, "certified_growth_rate_1_per_s") /
                                 valueOf(left.regime, "flutter_frequency_hz"));
  EXPECT_NEAR(largest[12] / largest[8], growth, 0.06);
  EXPECT_FALSE(fs::exists(vtk / ("regime_" + name) / "frame_013.pvtu"));
  const auto manifest = contentOf(left.folder / "manifest.txt");
  for (const auto& file : {"vtk/regime_" + name + ".pvd", "vtk/regime_" + name + "/frame_012.pvtu",
                           "vtk/regime_means_" + name + ".pvtu", std::string("regime_points.csv")})
    EXPECT_NE(manifest.find(file + "\n"), std::string::npos) << file;

  const auto grid = readVtu(vtk / ("regime_means_" + name + ".pvtu"));
  const auto pressure = left.nodes.column("mean_pressure_pa");
  EXPECT_NEAR(
      largestOf(*grid, "mean_pressure").first / *std::max_element(pressure.begin(), pressure.end()),
      1, 1e-6);
  EXPECT_EQ(largestOf(*grid, "slip").second, 45);
  EXPECT_EQ(largestOf(*grid, "open").second, 0);
  Reader file(left.folder / "results.h5");
  const auto [values, columns] = file.reals("/regime/friction_0.4/start_" + start, "mean_pressure");
  EXPECT_EQ(columns, 1);
  EXPECT_NEAR(std::accumulate(values.begin(), values.end(), 0.0) /
                  std::accumulate(pressure.begin(), pressure.end(), 0.0),
              1, 1e-8);
}

TEST(RegimeOutside, SoundSpectraAndFields) {
  const auto one = leftBy(runProgram("regime_outside", 1, commandLine(linear)));
  const auto two = leftBy(runAgain("regime_outside", 2, commandLine(linear)));
  for (const auto* left : {&one, &two}) checkSound(left->regime), checkSpectrum(*left);
  checkFields(two);
  // The rounding of the march, which stops its iterations at the same residual, is not the same.
  for (const std::string column : {"radiating_area_m2", "sound_power_estimate_w"})
    EXPECT_NEAR(valueOf(one.regime, column) / valueOf(two.regime, column), 1, 0.02);
  EXPECT_EQ(one.points.words("x_m"), two.points.words("x_m"));
  EXPECT_EQ(one.points.words("z_m"), two.points.words("z_m"));
}

}  // namespace
}  // namespace squeal::test
