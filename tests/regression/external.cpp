// The program on the committed matrices, as users start it: exact eigenvalues, vectors in the order of the file's rows, exports and the
// converter.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace squeal::test {
namespace {

using Complex = std::complex<double>;

std::vector<double> dataset(const fs::path& path, const std::string& name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  const hid_t space = H5Dget_space(set);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(file);
  return values;
}

// s² = −2 ± √(1 − 4f/3): both modes merge at friction 3/4.
TEST(External, MassOnABelt) {
  const ProgramRun run = runProgram("external/belt", 2, "-options_file options/external.yaml");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const CsvTable table = readCsv(run.folder / "eigenvalues.csv");
  const auto friction = table.column("friction"), growth = table.column("growth_rate_1_per_s"),
             frequency = table.column("angular_frequency_rad_per_s");
  ASSERT_EQ(friction.size(), 26U);  // both eigenvalues at 13 frictions
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const Complex s(growth[i], frequency[i]);
    double nearest = INFINITY;
    for (const double sign : {-1.0, 1.0})
      nearest = std::min(nearest, std::abs(s * s + 2.0 - sign * std::sqrt(Complex(1 - 4 * friction[i] / 3))));
    EXPECT_LT(nearest, 1e-13) << friction[i];
  }
  EXPECT_NE(run.out.find("0.7  none: steady sliding is stable"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("0.8  0.225546 (0.0911"), std::string::npos) << run.out;
  const auto summary = nlohmann::json::parse(contentOf(run.folder / "summary.json"));
  EXPECT_EQ(summary.at("dofs"), 2);
  EXPECT_EQ(summary.at("active_sets").at(0).at("modes"), 2);
  EXPECT_FALSE(summary.contains("nodes"));
  EXPECT_FALSE(fs::exists(run.folder / "vtk"));
  // The free modes are (1, −1) and (1, 1). With friction 1 the unstable one has (s² + 2) y = −x.
  const auto low = dataset(run.folder / "results.h5", "/modes/active_set_1/mode_001"),
             high = dataset(run.folder / "results.h5", "/modes/active_set_1/mode_002");
  ASSERT_EQ(low.size(), 2U);
  EXPECT_NEAR(low[0], -low[1], 1e-14);
  EXPECT_NEAR(high[0], high[1], 1e-14);
  const auto real = dataset(run.folder / "results.h5", "/flutter/friction_1/mode_002_real"),
             imaginary = dataset(run.folder / "results.h5", "/flutter/friction_1/mode_002_imaginary");
  const Complex x(real[0], imaginary[0]), y(real[1], imaginary[1]);
  EXPECT_LT(std::abs((-2.0 + Complex(0, std::sqrt(1. / 3)) + 2.0) * y + x), 1e-13);
}

// The friction at which the damped chain becomes unstable, by bisection on the eigenvalues of its companion matrix in NumPy.
TEST(External, DampedChainAtItsCriticalFriction) {
  const double critical = 0.80124204937;
  const std::string change =
      formatted("-options_file options/external_chain.yaml -flutter_unstable_tolerance 0 -flutter_friction %.12g,%.12g",
                critical * (1 - 1e-6), critical * (1 + 1e-6));
  const ProgramRun run = runProgram("external/chain", 2, change);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto summary = nlohmann::json::parse(contentOf(run.folder / "summary.json"));
  EXPECT_EQ(summary.at("frictions").at(0).at("unstable_modes").size(), 0U);
  EXPECT_EQ(summary.at("frictions").at(1).at("unstable_modes").size(), 1U);
}

TEST(External, ExportRunsOnOtherRanks) {
  const fs::path folder = placeFor("external") / "exported";
  const std::string wanted = " -report_fields off -quiet";
  const ProgramRun mesh = runProgram("external/mesh", 1,
                                     "-options_file options/two_layers.yaml -mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 40 "
                                     "-flutter_friction 0.3 -report_matrices '" +
                                         folder.string() + "'" + wanted);
  ASSERT_EQ(mesh.exitCode, 0) << mesh.error;
  const ProgramRun files = runProgram("external/files", 3, "-options_file '" + (folder / "options.txt").string() + "'" + wanted);
  ASSERT_EQ(files.exitCode, 0) << files.error;
  const CsvTable a = readCsv(mesh.folder / "eigenvalues.csv"), b = readCsv(files.folder / "eigenvalues.csv");
  const auto first = a.column("certified"), growth = a.column("growth_rate_1_per_s"),
             frequency = a.column("angular_frequency_rad_per_s"), otherGrowth = b.column("growth_rate_1_per_s"),
             otherFrequency = b.column("angular_frequency_rad_per_s");
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == 0) continue;
    double nearest = INFINITY;
    for (std::size_t j = 0; j < first.size(); ++j)
      nearest = std::min(nearest, std::abs(Complex(growth[i] - otherGrowth[j], frequency[i] - otherFrequency[j])));
    EXPECT_LT(nearest, 1e-10 * frequency[i]) << i;
  }
}

TEST(External, ConverterOfSciPyFiles) {
  const fs::path folder = placeFor("external") / "converter";
  fs::create_directories(folder);
  const std::string python = "/usr/bin/python3 -c \"import scipy.sparse as s; s.save_npz('" + (folder / "f.npz").string() +
                             "', s.csc_matrix(([-4/3], ([0], [1])), shape=(2, 2)))\"";
  ASSERT_EQ(std::system(python.c_str()), 0);
  for (const std::string target : {"f.mtx", "f.h5"}) {
    const std::string convert =
        "'" SQUEAL_SOURCE_DIR "/scripts/convert_matrix' '" + (folder / "f.npz").string() + "' '" + (folder / target).string() + "'";
    ASSERT_EQ(std::system(convert.c_str()), 0) << target;
    const ProgramRun run = runProgram("external/converted", 1,
                                      "-options_file options/external.yaml -quiet -report_fields off -flutter_friction 1 "
                                      "-matrices_friction_file '" +
                                          (folder / target).string() + "'");
    ASSERT_EQ(run.exitCode, 0) << run.error;
    const CsvTable table = readCsv(run.folder / "eigenvalues.csv");
    const Complex s(table.column("growth_rate_1_per_s").at(1), table.column("angular_frequency_rad_per_s").at(1));
    EXPECT_LT(std::abs(s * s + 2.0 - Complex(0, std::sqrt(1. / 3))), 1e-13) << target;
  }
}

}  // namespace
}  // namespace squeal::test
