// SPDX-License-Identifier: BSD-2-Clause
// A block clamped at its foot and pressed at its top by a sliding plate. Friction bends it and its
// nodes lift one after the other: the active set changes within a sweep, until at some friction no
// steady sliding state is left.
#include <map>
#include <set>

#include "support/harness/same_on_ranks.hpp"
#include "support/run/case.hpp"
#include "support/run/sliding_block.hpp"
#include "support/steady/complementarity.hpp"

namespace squeal::test {
namespace {

// 4 x 8 cells: 40 free nodes of 45, 5 of them in contact; a closed gap is not an unknown.
constexpr int contactNodes = 5, closedUnknowns = 75;

TEST(ActiveSet, SteadyStateIsTheOneThatExists) {
  const analysis::Analysis analysis =
      runOptions(block + "-modes_count 5 -flutter_friction 0:1:0.1");
  ASSERT_EQ(analysis.model.contact.interfaces.nodes.size(), static_cast<std::size_t>(contactNodes));
  int without = 0, opening = 0;
  for (const auto& steady : analysis.steady.solutions) {
    SCOPED_TRACE("friction " + std::to_string(steady.at.friction) + ": " + steady.reason);
    const auto solutions = allSolutions(condensed(analysis, steady.at.friction));
    std::printf(
        "friction %.1f: %zu solutions among %d active sets; SNES: %s after %d iterations, %d "
        "open\n",
        steady.at.friction, solutions.size(), 1 << contactNodes, steady.reason.c_str(),
        steady.iterations, static_cast<int>(steady.openNodes));
    EXPECT_EQ(steady.converged, !solutions.empty());
    without += solutions.empty();
    if (solutions.size() != 1 || !steady.converged) continue;
    opening += steady.openNodes > 0;
    const double largest = *std::max_element(solutions[0].force.begin(), solutions[0].force.end()),
                 widest = *std::max_element(solutions[0].gap.begin(), solutions[0].gap.end());
    for (std::size_t i = 0; i < analysis.model.contact.interfaces.nodes.size(); ++i) {
      // SNES stops at 1e-11 of the forces; near the last friction with a solution the gaps answer
      // with up to thirty times that. Gaps open from 1e-3 m.
      EXPECT_NEAR(steady.contact[i].gap, solutions[0].gap[i], 1e-9 * (1e-3 + widest));
      EXPECT_NEAR(steady.contact[i].normalForce, solutions[0].force[i], 1e-9 * largest);
      EXPECT_EQ(steady.closed[i] != 0, solutions[0].force[i] > 0);
    }
  }
  EXPECT_GE(without, 1);
  EXPECT_GE(opening, 3);
}

/// The sweep on this number of ranks, run once for the tests that read it.
const ProgramRun& sweepOn(int ranks) {
  static std::map<int, ProgramRun> runs;
  if (!runs.count(ranks))
    runs[ranks] = runProgram("active_set/sweep_np" + std::to_string(ranks), ranks,
                             block + "-modes_count 21 -flutter_friction 0:0.7:0.1 -quiet");
  return runs[ranks];
}

TEST(ActiveSet, ModesAreComputedAnewWhereItChanges) {
  const ProgramRun& sweep = sweepOn(1);
  ASSERT_EQ(sweep.exitCode, 0) << sweep.error;
  const Findings findings = findingsOf(sweep);
  const auto& sets = findings.summary.at("active_sets");
  ASSERT_GE(sets.size(), 3U);
  EXPECT_EQ(findings.summary.at("dofs"), closedUnknowns);
  std::vector<double> before;
  for (const auto& set : sets) {
    const int open = set.at("open_nodes"), unknowns = set.at("dofs");
    const double first = set.at("first_friction");
    std::printf("from friction %.1f: %d open nodes, %d unknowns\n", first, open, unknowns);
    EXPECT_EQ(unknowns, closedUnknowns + open);
    // The modes of the first set are computed; the others have those of the band, in the basis that
    // all share.
    const std::size_t modes = set.at("modes");
    EXPECT_EQ(modes, before.empty() ? 21U : findings.eigenvalues.at(first).size());
    EXPECT_TRUE(set.at("sturm_count").at("confirmed"));
    // Open nodes free the structure: no frequency rises (Rayleigh), and the first falls.
    const auto now =
        readCsv(sweep.folder / (before.empty() ? "modes.csv" : "modes_" + shortest(first) + ".csv"))
            .column("angular_frequency_rad_per_s");
    ASSERT_EQ(now.size(), modes);
    for (std::size_t i = 0; i < std::min(now.size(), before.size()); ++i)
      EXPECT_LE(now[i], before[i] * (1 + 1e-9)) << "mode " << i + 1;
    EXPECT_TRUE(before.empty() || now[0] < before[0] * (1 - 1e-6));
    before = now;
    // The path through the sweep has no influence: a run of this friction only, from the bonded
    // state, gives the same.
    const ProgramRun separate =
        runProgram("active_set/alone_" + shortest(first), 1,
                   block + "-modes_count 21 -quiet -flutter_friction " + shortest(first));
    ASSERT_EQ(separate.exitCode, 0) << separate.error;
    const Findings same = findingsOf(separate);
    EXPECT_LT(worst(errors(findings.eigenvalues.at(first), same.eigenvalues.at(first)).relative),
              1e-6);
    EXPECT_LT(forceDifference(findings.steady.at(first), same.steady.at(first)), 1e-8);
  }
}

// All active sets share one factorisation and one basis. Each eigenvalue is what a basis of its own
// gives, to the sum of both error estimates.
TEST(ActiveSet, OneBasisServesAllSets) {
  const ProgramRun& one = sweepOn(1);
  const ProgramRun each = runProgram("active_set/each", 1,
                                     block +
                                         "-modes_count 21 -flutter_friction 0:0.7:0.1 -quiet "
                                         "-flutter_released 0 -flutter_track off");
  ASSERT_EQ(one.exitCode, 0) << one.error;
  ASSERT_EQ(each.exitCode, 0) << each.error;
  const auto listOf = [](const ProgramRun& run) {
    const CsvTable table = readCsv(run.folder / "eigenvalues.csv");
    const auto friction = table.column("friction"), growth = table.column("growth_rate_1_per_s"),
               frequency = table.column("angular_frequency_rad_per_s"),
               estimate = table.column("error_estimate");
    std::map<double, std::vector<std::pair<Complex, double>>> list;
    for (std::size_t i = 0; i < friction.size(); ++i)
      list[friction[i]].push_back({{growth[i], frequency[i]}, estimate[i]});
    return list;
  };
  auto shared = listOf(one), separate = listOf(each);
  ASSERT_EQ(shared.size(), separate.size());
  std::size_t compared = 0;
  for (const auto& [friction, list] : shared)
    for (const auto& [s, estimate] : list) {
      // The bands end in a gap of the free modes of the basis, which is not the same.
      const auto& others = separate.at(friction);
      const auto nearest = std::ranges::min_element(others, {}, [&, wanted = s](const auto& other) {
        return std::abs(other.first - wanted);
      });
      const double apart = std::abs(nearest->first - s) / std::abs(s);
      if (std::abs(s) > std::abs(others.back().first) * (1 + 1e-6)) continue;
      ++compared;
      EXPECT_LT(apart, estimate + nearest->second + 1e-11)  // rounding of K0, a factor for each
          << s << " at friction " << friction;
    }
  EXPECT_GT(compared, 60U);
}

// The active sets follow each other: each is followed on its own interval of friction, between the
// frictions of contact_path.csv, and a critical friction lies in the interval of its set.
TEST(ActiveSet, BranchesRunThroughItsChanges) {
  const ProgramRun& run = sweepOn(1);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const CsvTable path = readCsv(run.folder / "contact_path.csv"),
                 branches = readCsv(run.folder / "branches.csv"),
                 criticals = readCsv(run.folder / "critical.csv");
  const auto events = path.column("friction");
  ASSERT_GE(events.size(), 2U);
  std::map<int, std::pair<double, double>> interval;  // [active set]
  std::map<double, std::set<int>> at;                 // [friction] numbers of branches there
  const auto set = branches.column("active_set"), friction = branches.column("friction"),
             number = branches.column("branch");
  for (std::size_t i = 0; i < set.size(); ++i) {
    auto& [low, high] = interval.try_emplace(set[i], friction[i], friction[i]).first->second;
    low = std::min(low, friction[i]), high = std::max(high, friction[i]);
    at[friction[i]].insert(number[i]);
  }
  EXPECT_GE(interval.size(), 3U);
  constexpr double digits = 1e-9;  // of the frictions in the tables
  for (const double event : events) {
    for (const auto& [number, ends] : interval) {  // none within the interval of an active set
      const bool within = event > ends.first + digits && event < ends.second - digits;
      EXPECT_FALSE(number > 0 && within) << event;
    }
    EXPECT_TRUE(std::ranges::any_of(at, [&](const auto& entry) {
      return std::abs(entry.first - event) < digits;
    })) << event;
  }
  const auto setOf = criticals.column("active_set"), where = criticals.column("friction");
  for (std::size_t i = 0; i < where.size(); ++i) {
    ASSERT_TRUE(interval.count(setOf[i]));
    EXPECT_GE(where[i], interval[setOf[i]].first - digits);
    EXPECT_LE(where[i], interval[setOf[i]].second + digits);
  }
  // The same is in summary.json.
  const auto summary = findingsOf(run).summary;
  const auto& listed = summary.at("contact_path");
  ASSERT_EQ(listed.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i)
    EXPECT_NEAR(listed.at(i).at("friction").get<double>(), events[i], digits);
  const auto& followed = summary.at("active_sets").at(0).at("followed").at(0);
  EXPECT_TRUE(followed.at("sturm_count_exact"));
  EXPECT_EQ(followed.at("active_sets").at(0), 1);
  // The first branch, the lowest eigenvalue, runs from one end to the other.
  for (const auto& [f, numbers] : at) EXPECT_TRUE(numbers.count(1)) << f;
}

TEST(ActiveSet, OpenNodesCarryNoFriction) {
  const ProgramRun& run = sweepOn(2);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const Findings findings = findingsOf(run);
  for (const std::size_t k : {1, 3, 5}) {
    const auto& entry = findings.summary.at("frictions").at(k);
    const double friction = entry.at("friction");
    ASSERT_NEAR(friction, 0.1 * static_cast<double>(k), 1e-12);
    const CsvTable& table = findings.steady.at(friction);
    const auto gap = table.column("gap_m"), normal = table.column("normal_force_n"),
               along = table.column("friction_force_x_n");
    ASSERT_EQ(gap.size(), static_cast<std::size_t>(contactNodes));
    const double largest = *std::max_element(normal.begin(), normal.end());
    int open = 0;
    for (std::size_t i = 0; i < gap.size(); ++i) {
      EXPECT_NEAR(along[i], friction * normal[i],
                  1e-10 * largest);  // the plate drags the block along with it
      if (gap[i] > 1e-12) {
        ++open;
        EXPECT_NEAR(normal[i], 0, 1e-9 * largest);
      } else {
        EXPECT_GE(gap[i], 0);
        EXPECT_GT(normal[i], 1e-6 * largest);
      }
    }
    EXPECT_EQ(entry.at("steady").at("open_nodes"), open);
    EXPECT_EQ(open > 0, friction > 0.2) << "friction " << friction;
  }
}

// With every mode kept the basis is the whole space, whichever nodes are open.
TEST(ActiveSet, ReducedAndDirectAgree) {
  for (const auto& [friction, open] :
       std::map<std::string, int>{{"0.1", 0}, {"0.4", 2}, {"0.5", 3}}) {
    SCOPED_TRACE("friction " + friction);
    const std::string all = std::to_string(closedUnknowns + open),
                      options = block + "-quiet -flutter_friction " + friction;
    const ProgramRun reduced =
        runProgram("active_set/reduced_" + friction, 1, options + " -modes_count " + all);
    const ProgramRun direct =
        runProgram("active_set/direct_" + friction, 1,
                   options + " -flutter_method direct -flutter_direct_count " + all);
    ASSERT_EQ(reduced.exitCode, 0) << reduced.error;
    ASSERT_EQ(direct.exitCode, 0) << direct.error;
    const auto eigenvaluesIn = [](const ProgramRun& run) {
      const CsvTable table = readCsv(run.folder / "eigenvalues.csv");
      const auto growth = table.column("growth_rate_1_per_s"),
                 frequency = table.column("angular_frequency_rad_per_s");
      std::vector<Complex> values;
      for (std::size_t i = 0; i < growth.size(); ++i) values.emplace_back(growth[i], frequency[i]);
      return values;
    };
    const auto one = eigenvaluesIn(reduced), other = eigenvaluesIn(direct);
    ASSERT_EQ(one.size(), static_cast<std::size_t>(closedUnknowns + open));
    ASSERT_EQ(other.size(), one.size());
    // Backward errors of 1e-13, times the condition of eigenvalues near where two of them meet.
    const double difference = worst(errors(one, other).relative);
    EXPECT_LT(difference, 1e-7);
    const auto count = [](const std::vector<Complex>& values) {
      return std::count_if(values.begin(), values.end(),
                           [](Complex s) { return s.real() > 1e-6 * std::abs(s); });
    };
    EXPECT_EQ(count(one), count(other));
    std::printf(
        "friction %s: reduced and direct differ by %.1e of |s| in %zu eigenvalues, %d unstable\n",
        friction.c_str(), difference, one.size(), static_cast<int>(count(one)));
  }
}

TEST(ActiveSet, SameOnOneAndTwoRanks) {
  std::vector<Findings> findings;
  for (int ranks : {1, 2}) {
    const ProgramRun& run = sweepOn(ranks);
    ASSERT_EQ(run.exitCode, 0) << run.error;
    findings.push_back(findingsOf(run));
  }
  expectSame(findings[0], findings[1], "active sets on 2 ranks");
  const auto& one = findings[0].summary.at("active_sets");
  const auto& two = findings[1].summary.at("active_sets");
  ASSERT_GE(one.size(), 3U);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    for (const char* key : {"first_friction", "last_friction", "open_nodes", "dofs"})
      EXPECT_EQ(one[i].at(key), two[i].at(key)) << key << " of set " << i + 1;
}

// tests/unit/steady/condensed/contact_path.cpp has the frictions by dense algebra.
TEST(ActiveSet, PathOfTheContact) {
  for (int ranks : {1, 2}) {
    const ProgramRun& run = sweepOn(ranks);
    ASSERT_EQ(run.exitCode, 0) << run.error;
    const CsvTable path = readCsv(run.folder / "contact_path.csv");
    const auto friction = path.column("friction"), x = path.column("x_m");
    ASSERT_GE(friction.size(), 3U);
    const double expected[] = {0.201354274411, 0.304739840891, 0.445639317271};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(friction[i], expected[i], 1e-9);
    EXPECT_TRUE(std::is_sorted(friction.begin(), friction.end()));
    EXPECT_TRUE(std::is_sorted(x.begin(), x.end(), std::greater<>()) ||
                std::is_sorted(x.begin(), x.end()));  // one after the other, from one end
  }
}

TEST(ActiveSet, FrictionWithoutSteadyState) {
  for (int ranks : {1, 2}) {
    SCOPED_TRACE(std::to_string(ranks) + " ranks");
    const ProgramRun run = runProgram("active_set/none_np" + std::to_string(ranks), ranks,
                                      block + "-modes_count 21 -flutter_friction 0.1,0.9,0.5");
    EXPECT_EQ(run.exitCode, 2) << run.error;
    EXPECT_NE(run.out.find("0.9  no steady sliding solution"), std::string::npos) << run.out;
    const auto friction = readCsv(run.folder / "eigenvalues.csv").column("friction");
    // The band ends above mode 11 or 12 of 21; friction may move a few across its edge.
    const auto low = std::count(friction.begin(), friction.end(), 0.1),
               high = std::count(friction.begin(), friction.end(), 0.5);
    EXPECT_GE(low, 10);
    EXPECT_GE(high, 10);
    EXPECT_EQ(static_cast<long>(friction.size()), low + high);
    EXPECT_NE(run.out.find("followed from friction 0.5 up to friction 0.7237147"),
              std::string::npos);
    EXPECT_NE(run.out.find("singular there"), std::string::npos);
    EXPECT_FALSE(fs::exists(run.folder / "steady_0.9.csv"));
    EXPECT_NE(contentOf(run.folder / "stability_map.csv").find("\n0.9,1,1,1,,,,,,,\n"),
              std::string::npos);
    const auto summary = nlohmann::json::parse(contentOf(run.folder / "summary.json"));
    EXPECT_EQ(summary.at("frictions").size(), 3U);
    for (const auto& entry : summary.at("frictions")) {
      const bool exists = entry.at("friction") != 0.9;
      EXPECT_EQ(entry.at("steady").at("converged"), exists);
      EXPECT_EQ(entry.at("steady").contains("exists_up_to"), !exists);
      EXPECT_EQ(entry.at("steady").at("snes_reason").get<std::string>().rfind("DIVERGED", 0) == 0,
                !exists);
      EXPECT_EQ(entry.contains("unstable_modes"), exists);
    }
  }
}

// Nothing at all to report is reported all the same.
TEST(ActiveSet, NoFrictionHasASteadyState) {
  const ProgramRun run =
      runProgram("active_set/nothing", 2,
                 block + "-report_fields on -modes_count 21 -flutter_friction 0.9 -quiet");
  EXPECT_EQ(run.exitCode, 2) << run.error;
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.error.find("no steady sliding solution"), std::string::npos)
      << "-quiet hides no failure";
  EXPECT_TRUE(readCsv(run.folder / "eigenvalues.csv").rows.empty());
  EXPECT_TRUE(
      nlohmann::json::parse(contentOf(run.folder / "summary.json")).at("active_sets").empty());
}

}  // namespace
}  // namespace squeal::test
