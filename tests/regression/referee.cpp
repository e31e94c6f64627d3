// SPDX-License-Identifier: BSD-2-Clause
// The referee on the matrices of a disc brake whose friction makes the symmetric part of the
// stiffness indefinite: lists of this program, changed ones and those of plain modal projection.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>

#include "support/harness/bad_input.hpp"
#include "support/harness/program.hpp"

namespace squeal::test {
namespace {

using Complex = std::complex<double>;

const Options coarse{{"options_file", "options/disc_brake.yaml"},
                     {"mesh_set",
                      "n_pad_theta=5,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=3,"
                      "n_hat=1,n_h_ring=1"},
                     {"flutter_friction", "0.6"},
                     {"flutter_band", "9000"},
                     {"modes_count", "100"},
                     {"report_fields", "off"}};

Options ofMatrices(const fs::path& matrices) {
  return {{"options_file", (matrices / "options.txt").string()}, {"report_fields", "off"}};
}

std::vector<Complex> valuesOf(const fs::path& csv, const std::string& before = "") {
  const auto table = readCsv(csv);
  const auto growth = table.words(before + "growth_rate_1_per_s"),
             frequency = table.words(before + "angular_frequency_rad_per_s");
  std::vector<Complex> values;
  for (std::size_t i = 0; i < growth.size(); ++i)
    values.emplace_back(growth[i].empty() ? NAN : std::stod(growth[i]),
                        frequency[i].empty() ? NAN : std::stod(frequency[i]));
  return values;
}

std::string listOf(const std::vector<Complex>& values) {
  std::string text = "real_hz,imaginary_hz\n";
  for (const auto s : values)
    text += formatted("%.12g,%.12g\n", s.real() / (2 * M_PI), s.imag() / (2 * M_PI));
  return text;
}

nlohmann::json verdictsOf(const fs::path& folder) {
  return nlohmann::json::parse(contentOf(folder / "summary.json")).at("referee").at("verdicts");
}

class RefereeRun : public testing::Test {
 protected:
  /// Exports the matrices and solves them with corrections, once for all tests.
  static void SetUpTestSuite() {
    fs::remove_all(matrices());
    const auto run = runProgram(
        "referee/solved", 1, commandLine(with(coarse, {{"report_matrices", matrices().string()}})));
    ASSERT_EQ(run.exitCode, 0) << run.error;
    solved = valuesOf(run.folder / "eigenvalues.csv");
    ASSERT_EQ(solved.size(), 32U);
  }
  static fs::path matrices() { return placeFor("referee/matrices"); }
  static ProgramRun judged(const std::string& name, int ranks, const fs::path& list) {
    return runProgram("referee/" + name, ranks,
                      commandLine(with(ofMatrices(matrices()), {{"referee_list", list.string()},
                                                                {"referee_top", "9150"}})));
  }
  static std::vector<Complex> solved;
};
std::vector<Complex> RefereeRun::solved;

// The corrections have estimated errors of 7e-9 of |s|, 4e-4 rad/s at the top.
TEST_F(RefereeRun, CompleteListOnTwoRanks) {
  const auto run = judged("complete", 2, placeFor("referee/solved/results/eigenvalues.csv"));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_NE(run.out.find("The list is complete and right: 32 right; proved: 64 eigenvalues"),
            std::string::npos)
      << run.out;
  const auto proved = valuesOf(run.folder / "referee.csv", "proved_");
  ASSERT_EQ(proved.size(), 32U);
  for (std::size_t i = 0; i < proved.size(); ++i) EXPECT_LT(std::abs(proved[i] - solved[i]), 1e-3);
  for (const double radius : readCsv(run.folder / "referee.csv").column("radius_rad_per_s"))
    EXPECT_LT(radius, 0.1);
  EXPECT_EQ(valuesOf(run.folder / "eigenvalues.csv").size(), 32U);
}

TEST_F(RefereeRun, EachFaultIsNamed) {
  auto list = solved;
  const Complex gone = list[18];
  list.erase(list.begin() + 18);
  list[24] += Complex(3, 30);
  list.push_back(list[3]);
  list.emplace_back(0, 12000);
  list.emplace_back(0, 70000);
  list.push_back(std::conj(list[5]));
  const fs::path file = placeFor("referee/changed.csv");
  writeText(file, listOf(list));
  const auto run = judged("changed", 1, file);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_NE(run.out.find("1 conjugates dropped"), std::string::npos) << run.out;
  const auto words = readCsv(run.folder / "referee.csv").words("verdict");
  ASSERT_EQ(words.size(), list.size());  // without the conjugate, with the missing one
  std::vector<std::string> expected(words.size(), "right");
  expected[24] = "inexact", expected[31] = "double", expected[32] = "artefact";
  expected[33] = "outside", expected[34] = "missing";
  EXPECT_EQ(words, expected);
  EXPECT_LT(std::abs(valuesOf(run.folder / "referee.csv", "proved_")[34] - gone), 1e-3);
}

// Free modes only, twice the range: two neutral eigenvalues take the place of an unstable mode.
// Entries of it that the exact ones contradict by more than the tolerance are not right.
TEST_F(RefereeRun, PlainModalProjection) {
  const auto modal = runProgram(
      "referee/modal", 1,
      commandLine(with(ofMatrices(matrices()), {{"flutter_basis", "modal"}, {"quiet", ""}})));
  ASSERT_EQ(modal.exitCode, 0) << modal.error;
  const auto run = judged("of_modal", 1, modal.folder / "eigenvalues.csv");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto table = readCsv(run.folder / "referee.csv");
  const auto words = table.words("verdict");
  const auto listed = valuesOf(run.folder / "referee.csv"),
             proved = valuesOf(run.folder / "referee.csv", "proved_");
  int missing = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    double nearest = INFINITY;
    const Complex s = words[i] == "missing" ? proved[i] : listed[i];
    for (const auto exact : solved) nearest = std::min(nearest, std::abs(s - exact));
    if (words[i] == "right") {
      EXPECT_LE(nearest, 1e-4 * std::abs(s) + 1e-3);
    } else if (words[i] == "inexact" || words[i] == "artefact") {
      EXPECT_GT(nearest, 1e-4 * std::abs(s));
    }
    if (words[i] != "missing") continue;
    ++missing;
    EXPECT_LT(nearest, 1e-3);
    EXPECT_NEAR(std::abs(s.real()), 13.63, 0.01);  // the entry is equally far from both
    EXPECT_NEAR(s.imag() / (2 * M_PI), 2184.31, 0.01);
  }
  EXPECT_EQ(missing, 1);
  const auto verdicts = verdictsOf(run.folder);
  EXPECT_EQ(verdicts.at("right").get<int>() + verdicts.at("inexact").get<int>(), 31);
}

TEST(Referee, Refusals) {
  const fs::path list = placeFor("referee/one.csv"), unitless = placeFor("referee/unitless.csv");
  writeText(list, "# rad/s\n0 1\n");
  writeText(unitless, "0 1\n");
  const Options belt{{"options_file", "options/external.yaml"}, {"flutter_friction", "0.2"}};
  const auto error = [](const Options& options) {
    const auto run = runProgram("referee/refused", 1, commandLine(options));
    EXPECT_EQ(run.exitCode, 1);
    return run.error;
  };
  const auto expect = [&](const Options& options, const std::string& words) {
    const auto message = error(options);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  expect(with(belt, {{"referee_list", unitless.string()}}), "give -referee_unit rad or Hz");
  expect(with(belt, {{"referee_list", list.string()}, {"flutter_friction", "0,0.1"}}),
         "a list belongs to one point, but the sweep has 2");
  expect(with(belt, {{"referee_list", list.string()}, {"flutter_modal_damping", "0.01"}}),
         "-flutter_modal_damping is not part of the matrices");
  expect(with(belt, {{"referee_top", "3"}}), "-referee_list");
  writeText(list, "# rad/s\n0 1\n-1 1e308\n");
  expect(with(belt, {{"referee_list", list.string()}}), "-1+1e+308i is larger than 1e+50 rad/s");
  expect(with(layer, {{"referee_list", list.string()}}), "-report_matrices");
}

}  // namespace
}  // namespace squeal::test
