// SPDX-License-Identifier: BSD-2-Clause
// The program on the committed matrices, as users start it: exact eigenvalues, vectors in the order
// of the file's rows, exports and the converter.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>

#include "support/harness/bad_input.hpp"
#include "support/harness/hdf5_reader.hpp"
#include "support/harness/program.hpp"

namespace squeal::test {
namespace {

using Complex = std::complex<double>;

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
      nearest = std::min(
          nearest, std::abs(s * s + 2.0 - sign * std::sqrt(Complex(1 - 4 * friction[i] / 3))));
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
  Reader results(run.folder / "results.h5");
  const auto low = results.reals("/modes/active_set_1", "mode_001").first,
             high = results.reals("/modes/active_set_1", "mode_002").first;
  ASSERT_EQ(low.size(), 2U);
  EXPECT_NEAR(low[0], -low[1], 1e-14);
  EXPECT_NEAR(high[0], high[1], 1e-14);
  const auto real = results.reals("/flutter/friction_1", "mode_002_real").first,
             imaginary = results.reals("/flutter/friction_1", "mode_002_imaginary").first;
  const Complex x(real[0], imaginary[0]), y(real[1], imaginary[1]);
  EXPECT_LT(std::abs((-2.0 + Complex(0, std::sqrt(1. / 3)) + 2.0) * y + x), 1e-13);
}

// The friction at which the damped chain becomes unstable, by bisection on the eigenvalues of its
// companion matrix in NumPy.
TEST(External, DampedChainAtItsCriticalFriction) {
  const double critical = 0.80124204937;
  const std::string change = formatted(
      "-options_file options/external_chain.yaml -flutter_unstable_tolerance 0 -flutter_friction "
      "%.12g,%.12g",
      critical * (1 - 1e-6), critical * (1 + 1e-6));
  const ProgramRun run = runProgram("external/chain", 1, change);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto summary = nlohmann::json::parse(contentOf(run.folder / "summary.json"));
  EXPECT_EQ(summary.at("frictions").at(0).at("unstable_modes").size(), 0U);
  EXPECT_EQ(summary.at("frictions").at(1).at("unstable_modes").size(), 1U);
}

// Both modes of the belt merge at 3/4, and the chain has the critical friction above: solved for,
// from a grid with steps of 0.1.
TEST(External, CriticalFrictionsAreSolvedFor) {
  for (const int ranks : {1, 2})
    for (const auto& [name, kind, exact, unknowns] :
         {std::tuple{"external", "coalescence", 0.75, 2},
          {"external_chain", "hopf", 0.80124204937, 10}}) {
      const ProgramRun run = runProgram(
          "external/critical", ranks,
          "-options_file options/" + std::string(name) + ".yaml -quiet -report_fields off");
      ASSERT_EQ(run.exitCode, 0) << run.error;
      const CsvTable table = readCsv(run.folder / "critical.csv");
      ASSERT_GE(table.rows.size(), 1U) << name;
      EXPECT_EQ(table.rows[0][3], kind);
      EXPECT_EQ(table.rows[0][4], "loss");
      EXPECT_NEAR(table.column("friction")[0], exact, 1e-8) << name;
      EXPECT_LT(table.column("friction_error_estimate")[0], 1e-8) << name;
      EXPECT_EQ(table.column("converged")[0], 1) << name;
      // All free modes span the whole space: of so few eigenvalues none is heavily damped, and
      // nothing is left to assume.
      const auto followed = nlohmann::json::parse(contentOf(run.folder / "summary.json"))
                                .at("active_sets")
                                .at(0)
                                .at("followed")
                                .at(0);
      EXPECT_EQ(followed.at("whole_space"), true);
      EXPECT_EQ(followed.at("branches"), unknowns);
      const std::string statement = followed.at("statement");
      EXPECT_EQ(statement.find(std::to_string(unknowns) +
                               " eigenvalues in the band at friction 0 (of the full problem"),
                0U)
          << statement;
      EXPECT_EQ(statement.find("not confirmed"), std::string::npos) << statement;
      EXPECT_EQ(statement.find("assumed"), std::string::npos) << statement;
    }
}

/// Options for a row of masses on springs as matrices, `bodies` times: eigenvalues of as many
/// bodies are the same. Those of the last one stand on springs to the ground of `ground` times the
/// others.
std::string rowsOfMasses(const std::string& name, int bodies, double ground) {
  constexpr int masses = 40, n = 2 * masses;
  std::map<std::string, std::map<std::pair<int, int>, double>> entries;
  for (int body = 0; body < bodies; ++body) {
    const auto spring = [&](int i, int j, double k) {
      auto& stiffness = entries["stiffness"];
      stiffness[{i, i}] += k, stiffness[{j, j}] += k, stiffness[{i, j}] -= k,
          stiffness[{j, i}] -= k;
    };
    const double held = body + 1 == bodies ? ground : 1;
    for (int k = 0; k < masses; ++k) {
      const int x = body * n + 2 * k, y = x + 1;
      entries["mass"][{x, x}] = entries["mass"][{y, y}] = 1 + 0.3 * std::sin(k);
      entries["stiffness"][{x, x}] += held;
      entries["stiffness"][{y, y}] += 1.1 * held;
      spring(x, y, 1. / 7);
      entries["friction"][{x, y}] = -0.4;
      if (k + 1 < masses) spring(x, x + 2, 1. / 3), spring(y, y + 2, 1. / 3);
    }
  }
  std::string options =
      "-matrices_friction_friction_exponent 1 -flutter_friction 0,0.3 -quiet -report_fields off ";
  for (const auto& [matrix, list] : entries) {
    std::string text = formatted("%%%%MatrixMarket matrix coordinate real general\n%d %d %zu\n",
                                 bodies * n, bodies * n, list.size());
    for (const auto& [place, value] : list)
      text += formatted("%d %d %.17g\n", place.first + 1, place.second + 1, value);
    const fs::path path = placeFor("external") / name / (matrix + ".mtx");
    writeText(path, text);
    options += "-matrices_" + matrix + "_file '" + path.string() + "' -matrices_" + matrix +
               "_role " + (matrix == "mass" ? "mass " : "stiffness ");
  }
  return options;
}

// More modes than unknowns are refused by name, as for a mesh, and not taken as all of them.
TEST(External, MoreModesThanUnknowns) {
  const ProgramRun run =
      runProgram("external/too_many", 2, rowsOfMasses("few", 1, 1) + "-modes_count 81");
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_NE(run.error.find("option -modes_count 81: the problem has only 80 unknowns"),
            std::string::npos)
      << run.error;
}

// Two equal bodies that do not touch: each eigenvalue of one, twice.
TEST(External, TwoEqualBodies) {
  const ProgramRun one =
      runProgram("external/one_body", 1, rowsOfMasses("one", 1, 1) + "-modes_count 30");
  const ProgramRun two =
      runProgram("external/two_bodies", 2,
                 rowsOfMasses("two", 2, 1) + "-modes_count 60 -flutter_tolerance 1e-9");
  ASSERT_EQ(one.exitCode, 0) << one.error;
  ASSERT_EQ(two.exitCode, 0) << two.error;
  const CsvTable single = readCsv(one.folder / "eigenvalues.csv"),
                 both = readCsv(two.folder / "eigenvalues.csv");
  const auto certified = both.column("certified");
  EXPECT_EQ(std::count(certified.begin(), certified.end(), 1), static_cast<long>(certified.size()));
  for (const double friction : {0.0, 0.3}) {
    const auto at = [&](const CsvTable& table) {
      const auto f = table.column("friction"), growth = table.column("growth_rate_1_per_s"),
                 angular = table.column("angular_frequency_rad_per_s");
      std::vector<Complex> list;
      for (std::size_t i = 0; i < f.size(); ++i)
        if (f[i] == friction) list.emplace_back(growth[i], angular[i]);
      return list;
    };
    const auto wanted = at(single), found = at(both);
    ASSERT_GE(wanted.size(), 12U);
    EXPECT_GE(found.size(), 24U);
    for (std::size_t i = 0; i < 12; ++i)  // well inside both bands
      EXPECT_EQ(std::count_if(found.begin(), found.end(),
                              [&](Complex s) {
                                return std::abs(s - wanted[i]) < 2e-8 * std::abs(wanted[i]);
                              }),
                2)
          << wanted[i] << " at friction " << friction;
  }
}

TEST(External, ALooseBodyIsSaid) {
  for (const int ranks : {1, 2}) {
    const ProgramRun run =
        runProgram("external/loose", ranks, rowsOfMasses("loose_body", 2, 0), 60);
    EXPECT_NE(run.exitCode, 0);
    EXPECT_NE(run.exitCode, 124) << "still running";
    EXPECT_NE(run.error.find("not positive definite: 0 negative and 1 zero"), std::string::npos)
        << run.error;
    EXPECT_FALSE(fs::exists(run.folder / "eigenvalues.csv"));
  }
}

TEST(External, ExportRunsOnOtherRanks) {
  const fs::path folder = placeFor("external") / "exported";
  const std::string wanted = " -report_fields off -quiet";
  const ProgramRun mesh = runProgram(
      "external/mesh", 1,
      "-options_file options/two_layers.yaml -mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 40 "
      "-flutter_friction 0.3 -report_matrices '" +
          folder.string() + "'" + wanted);
  ASSERT_EQ(mesh.exitCode, 0) << mesh.error;
  const ProgramRun files = runProgram(
      "external/files", 3, "-options_file '" + (folder / "options.txt").string() + "'" + wanted);
  ASSERT_EQ(files.exitCode, 0) << files.error;
  const CsvTable a = readCsv(mesh.folder / "eigenvalues.csv"),
                 b = readCsv(files.folder / "eigenvalues.csv");
  const auto first = a.column("certified"), growth = a.column("growth_rate_1_per_s"),
             frequency = a.column("angular_frequency_rad_per_s"),
             otherGrowth = b.column("growth_rate_1_per_s"),
             otherFrequency = b.column("angular_frequency_rad_per_s");
  ASSERT_EQ(a.rows.size(), b.rows.size());
  EXPECT_GE(std::count(first.begin(), first.end(), 1), 20);  // of 40 modes; the others are skipped
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == 0) continue;
    double nearest = INFINITY;
    for (std::size_t j = 0; j < first.size(); ++j)
      nearest = std::min(
          nearest, std::abs(Complex(growth[i] - otherGrowth[j], frequency[i] - otherFrequency[j])));
    EXPECT_LT(nearest, 1e-10 * frequency[i]) << i;
  }
  // The Sturm count is that of K0 and M0. Friction that is in the stiffness at friction 0 makes
  // another problem of it.
  const std::string again = "-options_file '" + (folder / "options.txt").string() +
                            "' -flutter_friction 0,0.1 -report_fields off",
                    frozen = " -matrices_frozen_file '" +
                             (folder / "stiffness_friction1.petsc").string() +
                             "' -matrices_frozen_role stiffness -matrices_frozen_factor 0.3";
  const ProgramRun free = runProgram("external/free", 1, again),
                   held = runProgram("external/frozen", 1, again + frozen);
  ASSERT_EQ(free.exitCode, 0) << free.error;
  ASSERT_EQ(held.exitCode, 0) << held.error;
  EXPECT_NE(free.out.find("(Sturm count, exact)"), std::string::npos) << free.out;
  EXPECT_NE(held.out.find("not confirmed by a Sturm count"), std::string::npos) << held.out;
}

TEST(External, ConverterOfSciPyFiles) {
  const fs::path folder = placeFor("external") / "converter";
  fs::create_directories(folder);
  const std::string python = "/usr/bin/python3 -c \"import scipy.sparse as s; s.save_npz('" +
                             (folder / "f.npz").string() +
                             "', s.csc_matrix(([-4/3], ([0], [1])), shape=(2, 2)))\"";
  ASSERT_EQ(std::system(python.c_str()), 0);
  for (const std::string target : {"f.mtx", "f.h5"}) {
    const std::string convert = "'" SQUEAL_SOURCE_DIR "/scripts/convert_matrix' '" +
                                (folder / "f.npz").string() + "' '" + (folder / target).string() +
                                "'";
    ASSERT_EQ(std::system(convert.c_str()), 0) << target;
    const ProgramRun run = runProgram(
        "external/converted", 1,
        "-options_file options/external.yaml -quiet -report_fields off -flutter_friction 1 "
        "-matrices_friction_file '" +
            (folder / target).string() + "'");
    ASSERT_EQ(run.exitCode, 0) << run.error;
    const CsvTable table = readCsv(run.folder / "eigenvalues.csv");
    const Complex s(table.column("growth_rate_1_per_s").at(1),
                    table.column("angular_frequency_rad_per_s").at(1));
    EXPECT_LT(std::abs(s * s + 2.0 - Complex(0, std::sqrt(1. / 3))), 1e-13) << target;
  }
}

/// The mass on a belt with its matrix of friction from `path`.
Options beltWith(const fs::path& path) {
  return {{"options_file", "options/external.yaml"},
          {"matrices_friction_file", path.string()},
          {"quiet", ""}};
}

// Each of them ran with other numbers, ended in a trace, or asked for the memory that a header
// names.
TEST(External, DamagedFilesAreSaid) {
  const fs::path place = placeFor("external/damaged");
  const std::string head = "%%MatrixMarket matrix coordinate real general\n2 2 1\n";
  const auto market = [&](const std::string& name, const std::string& text) {
    writeText(place / name, text);
    return beltWith(place / name);
  };
  // MATLAB's version 4: [[0, -4/3], [0, 0]] by columns, after a header of five integers and the
  // name.
  const std::int32_t words[] = {0, 2, 2, 0, 2};
  const double values[] = {0, 0, -4. / 3, 0};
  const std::string matlab = std::string(reinterpret_cast<const char*>(words), sizeof words) +
                             std::string("f\0", 2) +
                             std::string(reinterpret_cast<const char*>(values), sizeof values);
  // PETSc: class, rows, columns, entries, the length of each row, columns, values; big-endian.
  const auto petsc = [](const std::string& lengthsAndColumns) {
    return std::string("\0\x12\x7b\x50\0\0\0\2\0\0\0\2\0\0\0\1", 16) + lengthsAndColumns +
           std::string(8, '\0');
  };
  const Options sound = market("sound.mat", matlab);
  const std::vector<BadInput> inputs{
      {"cut_mat",
       market("cut.mat", matlab.substr(0, matlab.size() - 9)),
       {"-matrices_friction_file", "cut.mat", "the file is truncated"}},
      {"comma",
       market("comma.mtx", head + "1 2 4,9\n"),
       {"comma.mtx", "line 3: the value '4,9' is not a number"}},
      {"petsc_column",
       market("column.petsc", petsc(std::string("\0\0\0\1\0\0\0\0\0\0\0\7", 12))),
       {"column.petsc", "row 0 (counted from 0) has an entry in column 7 of 2"}},
      {"petsc_lengths",
       market("lengths.petsc", petsc(std::string("\0\0\0\2\xff\xff\xff\xff\0\0\0\0", 12))),
       {"lengths.petsc", "row 0 (counted from 0) has more entries than the header announces"}},
      {"huge",
       market("huge.mtx",
              "%%MatrixMarket matrix coordinate real general\n2000000000 2000000000 1\n1 2 4\n"),
       {"huge.mtx", "2000000000 rows with 1 entries"}},
      {"none", beltWith(place / "none.mtx"), {"none.mtx", "o such file"}},
  };
  for (const int ranks : {1, 2}) expectExplained(inputs, ranks);
  const ProgramRun run =
      runProgram("external/version4", 2, commandLine(with(sound, {{"report_fields", "off"}})));
  EXPECT_EQ(run.exitCode, 0) << run.error;
}

}  // namespace
}  // namespace squeal::test
