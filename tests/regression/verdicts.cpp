// SPDX-License-Identifier: BSD-2-Clause
// Features that meet: contact that closes within a step, a third eigenvalue beside two that merge,
// eigenvalues that are exactly zero, a body that is held weakly or at some frictions only. Nothing
// crashes, and no verdict stands without a result behind it.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "support/harness/program.hpp"
#include "support/harness/same_on_ranks.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

const std::string inputs = SQUEAL_SOURCE_DIR "/tests/inputs/";

std::string caseFile(const std::string& name) {
  return "-options_file " + inputs + name + ".yaml ";
}

/// Writes a matrix, given by rows, as a Matrix Market file, and returns its option.
std::string matrix(const std::string& test, const std::string& name,
                   const std::vector<std::vector<double>>& rows, const std::string& role) {
  std::string entries;
  int count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j)
      if (rows[i][j] != 0) {
        entries += formatted("%zu %zu %.17g\n", i + 1, j + 1, rows[i][j]);
        ++count;
      }
  const fs::path path = placeFor("verdicts_matrices") / (test + "_" + name + ".mtx");
  writeText(path, "%%MatrixMarket matrix coordinate real general\n" +
                      formatted("%zu %zu %d\n", rows.size(), rows.size(), count) + entries);
  const std::string option = " -matrices_" + name;
  return option + "_file " + path.string() + option + "_role " + role;
}

std::vector<std::vector<double>> diagonal(const std::vector<double>& entries) {
  std::vector<std::vector<double>> rows(entries.size(), std::vector<double>(entries.size()));
  for (std::size_t i = 0; i < entries.size(); ++i) rows[i][i] = entries[i];
  return rows;
}

void expectFinite(const ProgramRun& run) {
  const std::string table = contentOf(run.folder / "eigenvalues.csv");
  EXPECT_EQ(table.find("nan"), std::string::npos) << table;
  EXPECT_EQ(table.find("inf"), std::string::npos) << table;
}

/// The case closing_contact at its frictions, 0 and 0.2; two tests read it.
const ProgramRun& closingContact(int ranks) {
  static std::map<int, ProgramRun> runs;
  if (!runs.contains(ranks))
    runs[ranks] = runProgram("verdicts_contact_" + std::to_string(ranks), ranks,
                             caseFile("closing_contact/case"), 60);
  return runs[ranks];
}

// Nodes open between frictions 0 and 0.2: the reduced problems at both ends of the step have
// different orders.
TEST(Verdicts, ContactThatChangesWithinAStep) {
  const auto single = runProgram("verdicts_contact_alone", 1,
                                 caseFile("closing_contact/case") + "-flutter_track off", 60);
  for (const int ranks : {1, 2}) {
    const ProgramRun& run = closingContact(ranks);
    ASSERT_EQ(run.exitCode, 0) << run.error;
    EXPECT_EQ(run.error.find("defect"), std::string::npos) << run.error;
    const auto found = eigenvaluesOf(readCsv(run.folder / "eigenvalues.csv")),
               wanted = eigenvaluesOf(readCsv(single.folder / "eigenvalues.csv"));
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i)  // -flutter_tolerance is 1e-8
      EXPECT_LE(std::abs(found[i] - wanted[i]), 2e-8 * std::abs(wanted[i]));
  }
}

// The default band follows from the free modes of a point's own active set, not from those of the
// sets that share its basis.
TEST(Verdicts, PointListsTheSameAloneAndInASweep) {
  const auto eigenvaluesAt = [](const std::string& name, const std::string& frictions) {
    const auto run =
        runProgram("verdicts_band_" + name, 1,
                   caseFile("closing_contact/case") + "-flutter_friction " + frictions, 60);
    EXPECT_EQ(run.exitCode, 0) << run.error;
    return eigenvaluesOf(readCsv(run.folder / "eigenvalues.csv"));
  };
  const auto swept = eigenvaluesOf(readCsv(closingContact(1).folder / "eigenvalues.csv"));
  auto single = eigenvaluesAt("first", "0");
  for (const auto& s : eigenvaluesAt("second", "0.2")) single.push_back(s);
  ASSERT_EQ(swept.size(), single.size());
  for (std::size_t i = 0; i < swept.size(); ++i)  // -flutter_tolerance is 1e-8
    EXPECT_LE(std::abs(swept[i] - single[i]), 2e-8 * std::abs(single[i]));
}

// Two eigenvalues merge at 0.029666628 while a third one passes by. The same model with the slave
// of its tie named by fewer faces has the same critical friction, and so has the exchange of slave
// and master.
TEST(Verdicts, CriticalFrictionBesideAThirdEigenvalue) {
  for (const auto& [name, ranks] : {std::pair{"skin", 1}, {"bottom", 2}}) {
    const auto run = runProgram(std::string("verdicts_critical_") + name, ranks,
                                caseFile(std::string("passing_eigenvalue/") + name));
    ASSERT_EQ(run.exitCode, 0) << run.error;
    const auto table = readCsv(run.folder / "critical.csv");
    ASSERT_EQ(table.rows.size(), 6U);
    // -flutter_critical_tolerance is 1e-8.
    EXPECT_NEAR(table.column("friction")[0], 0.029666628, 2e-9);
    for (const double converged : table.column("converged")) EXPECT_EQ(converged, 1);
  }
}

// K = diag(1, 1, 4, 9, 16, 25) with one free mode, and friction that couples the rows in a chain
// 1–3–4–2–5–6. At friction 0 the double eigenvalue i is exact in the first basis, which holds one
// of its two vectors; the corrections at the other frictions add the second one. Both must be
// listed.
TEST(Verdicts, ListIsReadAgainInTheBasisOfAllPoints) {
  std::vector<std::vector<double>> chain(6, std::vector<double>(6));
  for (const auto& [i, j] : {std::pair{0, 2}, {2, 3}, {3, 1}, {1, 4}, {4, 5}})
    chain[j][i] = 0.3, chain[i][j] = -0.1;
  const auto run =
      runProgram("verdicts_grown", 1,
                 matrix("grown", "m", diagonal({1, 1, 1, 1, 1, 1}), "mass") +
                     matrix("grown", "k", diagonal({1, 1, 4, 9, 16, 25}), "stiffness") +
                     matrix("grown", "f", chain, "stiffness") +
                     " -matrices_f_friction_exponent 1 -flutter_friction 0,0.01,1 -modes_count 1");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto table = readCsv(run.folder / "eigenvalues.csv");
  const auto friction = table.column("friction"), frequency = table.column("frequency_hz");
  ASSERT_EQ(std::ranges::count(friction, 0), 2) << run.out;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(2 * M_PI * frequency[i], 1, 1e-9);
}

// K = diag(1 − 1.5 f, 4), M = I, C = 0.01 I: a complex pair becomes two real eigenvalues, one of
// which is positive from f = 2/3 on. The step from 0 to 1 contains both, and the branches are not
// matched there. The change of stability must be listed all the same.
TEST(Verdicts, ChangeBetweenBranchesThatAreNotMatched) {
  const auto run = runProgram("verdicts_unmatched", 1,
                              matrix("unmatched", "m", diagonal({1, 1}), "mass") +
                                  matrix("unmatched", "k", diagonal({1, 4}), "stiffness") +
                                  matrix("unmatched", "c", diagonal({0.01, 0.01}), "damping") +
                                  matrix("unmatched", "f", diagonal({-1.5, 0}), "stiffness") +
                                  " -matrices_f_friction_exponent 1 -flutter_friction 0,1");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const auto critical = readCsv(run.folder / "critical.csv");
  ASSERT_EQ(critical.rows.size(), 1U);
  EXPECT_LE(std::abs(critical.column("friction")[0] - 2. / 3),
            critical.column("friction_error_estimate")[0] + 1e-8);
  EXPECT_LT(critical.column("friction_error_estimate")[0], 1e-3);
  EXPECT_EQ(critical.words("direction")[0], "loss");
  EXPECT_EQ(critical.column("converged")[0], 0);
  for (const char* number : {"branch", "partner"}) EXPECT_EQ(critical.column(number)[0], 0);
}

// K = diag(1 − f, 2), M = I: at f = 1 the double root s = 0 has one vector. With damping 0.1 it is
// simple, s = 0 and s = −0.1.
TEST(Verdicts, ZeroIsAnEigenvalue) {
  const std::string undamped = matrix("zero", "m", diagonal({1, 1}), "mass") +
                               matrix("zero", "k", diagonal({1, 2}), "stiffness") +
                               matrix("zero", "d", diagonal({-1, 0}), "stiffness") +
                               " -matrices_d_friction_exponent 1 -flutter_friction 0,1,2",
                    damped = undamped + matrix("zero", "c", diagonal({0.1, 0.1}), "damping");
  for (const auto& [name, ranks, options] :
       {std::tuple{"undamped", 2, undamped}, {"damped", 1, damped}}) {
    SCOPED_TRACE(name);
    const auto run = runProgram(std::string("verdicts_zero_") + name, ranks, options);
    ASSERT_EQ(run.exitCode, 0) << run.error;
    expectFinite(run);
    const auto critical = readCsv(run.folder / "critical.csv");
    ASSERT_EQ(critical.rows.size(), 1U);
    EXPECT_NEAR(critical.column("friction")[0], 1, 1e-12);
    EXPECT_EQ(critical.words("kind")[0], "divergence");
    EXPECT_EQ(critical.words("direction")[0], "loss");
    const auto table = readCsv(run.folder / "eigenvalues.csv");
    const auto friction = table.column("friction"), growth = table.column("growth_rate_1_per_s"),
               angular = table.column("angular_frequency_rad_per_s");
    const auto verdict = table.words("verdict");
    int zeros = 0;
    for (std::size_t i = 0; i < friction.size(); ++i)
      if (friction[i] == 1 && angular[i] == 0 && growth[i] == 0) {
        ++zeros;
        EXPECT_EQ(verdict[i], "undecided");  // any small change of K may make it grow or not
      }
    EXPECT_EQ(zeros, 1);
    EXPECT_NE(run.out.find("all tracked"), std::string::npos) << run.out;
  }
}

// K = [1, f³; −f³, 4]: the eigenvalues meet where 2 f³ = 3. Between points too far apart that is
// not resolved, and is not said to be.
TEST(Verdicts, CriticalFrictionBetweenPointsFarApart) {
  const double exact = std::cbrt(1.5);
  for (const char* last : {"10", "1e12", "1e50"}) {
    const auto run =
        runProgram(std::string("verdicts_far_") + last, 1,
                   matrix("far", "m", diagonal({1, 1}), "mass") +
                       matrix("far", "k", diagonal({1, 4}), "stiffness") +
                       matrix("far", "f", {{0, 1}, {-1, 0}}, "stiffness") +
                       " -matrices_f_friction_exponent 3 -flutter_friction 0,0.1," + last);
    ASSERT_EQ(run.exitCode, 0) << run.error;
    const auto table = readCsv(run.folder / "critical.csv");
    ASSERT_EQ(table.rows.size(), 1U);
    const double found = table.column("friction")[0],
                 estimate = table.column("friction_error_estimate")[0];
    EXPECT_LE(std::abs(found - exact), estimate);
    // -flutter_critical_tolerance is 1e-8.
    EXPECT_EQ(table.column("converged")[0], estimate <= 1e-8 * exact ? 1 : 0);
  }
}

// A string that rotates at its critical speed has no stiffness: for K = (1 − v²) diag(1, 1, 4, 4)
// and gyroscopic forces 2 v n, its eigenvalues are i n (1 ± v), of which two for each n vanish at
// v = 1.
TEST(Verdicts, StiffnessVanishesAtOnePoint) {
  std::vector<std::vector<double>> g = diagonal({0, 0, 0, 0});
  for (const int k : {0, 1}) {
    g[2 * k][2 * k + 1] = 2 * (k + 1);
    g[2 * k + 1][2 * k] = -2 * (k + 1);
  }
  const auto run = runProgram(
      "verdicts_string", 1,
      matrix("string", "m", diagonal({1, 1, 1, 1}), "mass") +
          matrix("string", "k", diagonal({1, 1, 4, 4}), "stiffness") +
          matrix("string", "kv", diagonal({-1, -1, -4, -4}), "stiffness") +
          matrix("string", "g", g, "damping") +
          " -matrices_kv_speed_exponent 2 -matrices_g_speed_exponent 1 -flutter_speed 0.5,1,1.5");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  expectFinite(run);
  const auto table = readCsv(run.folder / "eigenvalues.csv");
  const auto speed = table.column("speed"), angular = table.column("angular_frequency_rad_per_s");
  const std::map<double, std::vector<double>> exact{
      {0.5, {0.5, 1, 1.5, 3}}, {1, {0, 0, 0, 0, 2, 4}}, {1.5, {0.5, 1, 2.5, 5}}};
  for (const auto& [at, wanted] : exact) {
    std::vector<double> found;
    for (std::size_t i = 0; i < speed.size(); ++i)
      if (speed[i] == at) found.push_back(angular[i]);
    ASSERT_EQ(found.size(), wanted.size()) << at;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-13);
  }
}

// ω = √(k/m) of a rigid block on a spring that is 1e13 times softer than its own entries of K: the
// error estimate holds what their round-off may change.
TEST(Verdicts, EstimateContainsTheRoundOffOfTheStiffness) {
  constexpr double exact = 2.523773;
  const auto run = runProgram("verdicts_weak", 1, caseFile("weak_ground/case"));
  const auto table = readCsv(run.folder / "eigenvalues.csv");
  const double found = table.column("angular_frequency_rad_per_s").at(0),
               estimate = table.column("error_estimate").at(0);
  std::printf("rigid block: error %.2e, estimate %.2e\n", std::abs(found / exact - 1), estimate);
  EXPECT_LE(std::abs(found / exact - 1), estimate);
  EXPECT_LE(estimate, 1e-3);  // ε ΣK_ii / (2 k): an estimate that says nothing is none
  EXPECT_EQ(table.column("certified").at(0), 0);
}

// A damping matrix of zeros counts as none.
TEST(Verdicts, DampingWithoutEntriesIsNone) {
  const std::string options =
      matrix("none", "m", diagonal({1, 1, 1}), "mass") +
      matrix("none", "k", {{2, -1, 0}, {-1, 3, -1}, {0, -1, 4}}, "stiffness") +
      matrix("none", "n", {{0, 0.1, 0}, {-0.1, 0, 0}, {0, 0, 0}}, "stiffness") +
      " -matrices_n_friction_exponent 1 -flutter_friction 0,0.1";
  const auto without = runProgram("verdicts_without", 1, options),
             with = runProgram("verdicts_zero_damping", 1,
                               options + matrix("none", "c", diagonal({0, 0, 0}), "damping"));
  ASSERT_EQ(with.exitCode, 0) << with.error;
  EXPECT_EQ(contentOf(with.folder / "eigenvalues.csv"),
            contentOf(without.folder / "eigenvalues.csv"));
  EXPECT_NE(with.out.find("3 of 3 eigenvalues neutral"), std::string::npos);
  EXPECT_EQ(with.out.find("undecided"), std::string::npos) << with.out;
}

// At friction 0 nothing presses the pad against its abutment, and nothing holds it along x. The
// other frictions have solutions.
TEST(Verdicts, PointWhereABodyIsLooseFailsForItself) {
  const auto others =
      runProgram("verdicts_held", 1, caseFile("open_abutment/case") + "-flutter_friction 0.3,0.6");
  EXPECT_EQ(others.exitCode, 0) << others.error;
  for (const int ranks : {1, 2}) {
    const auto run = runProgram("verdicts_loose_" + std::to_string(ranks), ranks,
                                caseFile("open_abutment/case"));
    EXPECT_EQ(run.exitCode, 2) << run.error;
    EXPECT_NE(run.error.find("friction 0: body 'pad' is under-constrained (translation x: 1)"),
              std::string::npos)
        << run.error;
    const auto found = eigenvaluesOf(readCsv(run.folder / "eigenvalues.csv")),
               wanted = eigenvaluesOf(readCsv(others.folder / "eigenvalues.csv"));
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_LE(std::abs(found[i] - wanted[i]), 2e-8 * std::abs(wanted[i]));  // -flutter_tolerance
  }
}

// A pad that the contact and a spring along it alone hold: without friction SNES opens all its
// nodes and stops. Complementary pivots find the state, in which three nodes are open.
TEST(Verdicts, PadHeldByTheContactAloneSlidesWithoutFriction) {
  for (const int ranks : {1, 2}) {
    const auto run = runProgram("verdicts_floating_" + std::to_string(ranks), ranks,
                                caseFile("floating_pad/case"));
    EXPECT_EQ(run.exitCode, 0) << run.error;
    for (const char* friction : {"0", "0.1538", "0.3075"}) {
      const auto gaps =
          readCsv(run.folder / (std::string("steady_") + friction + ".csv")).column("gap_m");
      EXPECT_EQ(gaps.size(), 8U);
      EXPECT_EQ(std::ranges::count_if(gaps, [](double gap) { return gap > 0; }), 3);
    }
  }
}

// Where a node of the other pad opens, that one is loose, and no state follows: 0.647318251 on any
// number of ranks. The equations of a loose body have no solution.
TEST(Verdicts, SteadySlidingEndsAtTheSameFrictionOnAnyNumberOfRanks) {
  for (const int ranks : {1, 2, 3}) {
    const auto run = runProgram("verdicts_floating_end_" + std::to_string(ranks), ranks,
                                caseFile("floating_pad/case") + "-flutter_friction 0.5,1");
    EXPECT_EQ(run.exitCode, 2) << run.error;
    EXPECT_NE(run.error.find("followed from friction 0.5 up to friction 0.64731825"),
              std::string::npos)
        << run.error;
  }
}

// At friction 0.2 none of the nodes of a sticking interface slides, at 0.205 and beyond one does.
// Where that begins between two points is not solved for: no critical friction of the later set is
// listed before it, and the change of stability lies between the points.
TEST(Verdicts, NodesThatBeginToSlideBetweenPoints) {
  const auto run = runProgram("verdicts_release", 1, caseFile("sliding_back/case"));
  EXPECT_EQ(run.exitCode, 0) << run.error;
  EXPECT_NE(run.out.find("Stability also changes, at a friction not computed, between 0 and "
                         "0.2068 (contact near 4.542e+04 Hz)"),
            std::string::npos)
      << run.out;
  const auto table = readCsv(run.folder / "critical.csv");
  ASSERT_EQ(table.rows.size(), 2U);
  for (const double converged : table.column("converged")) EXPECT_EQ(converged, 0);
  for (const double friction : table.column("friction")) EXPECT_DOUBLE_EQ(friction, 0.2068 / 2);
  for (const double error : table.column("friction_error_estimate"))
    EXPECT_NEAR(error, 0.2068 / 2, 5e-3);  // written with two digits
  const auto before = runProgram(
      "verdicts_release_before", 1,
      caseFile("sliding_back/case") + "-flutter_friction 0.145,0.2 -flutter_method direct");
  for (const auto& s : eigenvaluesOf(readCsv(before.folder / "eigenvalues.csv")))
    EXPECT_LT(s.real(), s.imag() < 3e5 ? 1e-6 * std::abs(s) : INFINITY);
}

// Too small a subspace for the direct method at some of the points: these are named, and the others
// have their eigenvalues.
TEST(Verdicts, PointThatDoesNotConvergeFailsForItself) {
  const auto run =
      runProgram("verdicts_unconverged", 1,
                 "-options_file options/two_layers.yaml -mesh_set nx=30,ny_disc=10,ny_pad=8 "
                 "-flutter_friction 0,0.2,0.5,0.9,1.5 -flutter_method direct "
                 "-flutter_direct_count 12 -flutter_eps_max_it 1 -flutter_eps_ncv 44");
  EXPECT_EQ(run.exitCode, 2) << run.error;
  std::set<double> solved;
  for (const double friction : readCsv(run.folder / "eigenvalues.csv").column("friction"))
    solved.insert(friction);
  EXPECT_FALSE(solved.empty());
  for (const double friction : {0.0, 0.2, 0.5, 0.9, 1.5}) {
    const std::string named = formatted("direct method at friction %g: only", friction);
    EXPECT_EQ(run.error.find(named) == std::string::npos, solved.count(friction) > 0)
        << named << "\n"
        << run.error;
  }
}

// Where the nodes of a tie match, slave and master are one model however they are named: with a
// held component on the slave's nodes, and with nodes of the slave in contact.
TEST(Verdicts, SlaveAndMasterOfATieMayBeExchanged) {
  for (const std::string name : {"tie_clamped_slave", "tie_slave_in_contact"}) {
    SCOPED_TRACE(name);
    const auto run = runProgram("verdicts_" + name, 1, caseFile(name + "/reference")),
               exchanged =
                   runProgram("verdicts_" + name + "_exchanged", 2, caseFile(name + "/exchanged"));
    ASSERT_EQ(run.exitCode, 0) << run.error;
    ASSERT_EQ(exchanged.exitCode, 0) << exchanged.error;
    const auto modes = readCsv(run.folder / "modes.csv").column("frequency_hz"),
               others = readCsv(exchanged.folder / "modes.csv").column("frequency_hz");
    ASSERT_EQ(modes.size(), others.size());
    for (std::size_t i = 0; i < modes.size() / 2; ++i)  // the upper ones are solved for to less
      EXPECT_LE(std::abs(others[i] / modes[i] - 1), 1e-9) << i;
    const auto wanted = eigenvaluesOf(readCsv(run.folder / "eigenvalues.csv")),
               found = eigenvaluesOf(readCsv(exchanged.folder / "eigenvalues.csv"));
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i)  // each is correct to -flutter_tolerance, 1e-8
      EXPECT_LE(std::abs(found[i] - wanted[i]), 2e-8 * std::abs(wanted[i]));
  }
  // The plate and pad with the nodes of both merged, by other hex8 elements.
  const auto modes = readCsv(placeFor("verdicts_tie_clamped_slave_exchanged") / "results/modes.csv")
                         .column("frequency_hz");
  const double exact[] = {6682.01, 12469.9, 19296.7};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(modes[i] / exact[i], 1, 5e-6);
}

}  // namespace
}  // namespace squeal::test
