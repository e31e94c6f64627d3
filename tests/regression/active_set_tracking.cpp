// SPDX-License-Identifier: BSD-2-Clause
// Eigenvalues tracked through the active sets of a sweep: from basis to basis, and where each set
// has terms of its own.
#include <map>
#include <set>

#include "support/harness/same_on_ranks.hpp"
#include "support/run/case.hpp"
#include "support/run/sliding_block.hpp"

namespace squeal::test {
namespace {

/// The ends of a branch: its eigenvalues at the first and at the last friction.
using Ends = std::pair<Complex, Complex>;

/// Returns the ends of each branch that runs through the whole sweep, by its first frequency.
std::vector<Ends> throughBranches(const ProgramRun& run) {
  const CsvTable table = readCsv(run.folder / "branches.csv");
  const auto number = table.column("branch"), friction = table.column("friction"),
             growth = table.column("growth_rate_1_per_s"),
             frequency = table.column("angular_frequency_rad_per_s");
  const double last = std::ranges::max(friction);
  std::map<int, std::map<double, Complex>> branches;
  for (std::size_t i = 0; i < number.size(); ++i)
    branches[number[i]].emplace(friction[i], Complex(growth[i], frequency[i]));
  std::vector<Ends> ends;
  for (const auto& [branch, values] : branches)
    if (values.count(0) && values.count(last)) ends.push_back({values.at(0), values.at(last)});
  std::ranges::sort(ends, {}, [](const Ends& one) { return one.first.imag(); });
  return ends;
}

// With at most one node that changes, the sweep takes three bases. Each begins with the last point
// of the one before, where its branches are continued: they and the critical frictions are those of
// a single basis, within the tolerance of both, 1e-8.
TEST(Tracking, BranchesContinueInTheNextBasis) {
  const ProgramRun one = runProgram("active_set/one_basis", 1,
                                    block + "-modes_count 21 -flutter_friction 0:0.7:0.1 -quiet");
  ASSERT_EQ(one.exitCode, 0) << one.error;
  const auto wanted = throughBranches(one);
  ASSERT_GE(wanted.size(), 10U);
  const CsvTable criticals = readCsv(one.folder / "critical.csv");
  const auto eigenvalues = readCsv(one.folder / "eigenvalues.csv").column("friction");
  for (const int ranks : {1, 2}) {
    const ProgramRun run = runProgram("active_set/bases_np" + std::to_string(ranks), ranks,
                                      block +
                                          "-modes_count 21 -flutter_friction 0:0.7:0.1 "
                                          "-flutter_released 1");
    ASSERT_EQ(run.exitCode, 0) << run.error;
    std::size_t bases = 0;
    for (auto at = run.out.find("\ntrack "); at != std::string::npos;
         at = run.out.find("\ntrack ", at + 1))
      ++bases;
    EXPECT_EQ(bases, 3U) << run.out;
    const auto found = throughBranches(run);
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_LT(std::abs(found[i].first - wanted[i].first), 1e-7 * std::abs(wanted[i].first));
      EXPECT_LT(std::abs(found[i].second - wanted[i].second), 1e-7 * std::abs(wanted[i].second));
    }
    const CsvTable others = readCsv(run.folder / "critical.csv");
    EXPECT_EQ(others.column("active_set"), criticals.column("active_set"));
    for (const char* column : {"friction", "frequency_hz"}) {
      const auto here = others.column(column), there = criticals.column(column);
      ASSERT_EQ(here.size(), there.size());
      for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(here[i] / there[i], 1, 1e-7);
    }
    // Each point is listed once, and one line is followed through all active sets.
    EXPECT_EQ(readCsv(run.folder / "eigenvalues.csv").column("friction"), eigenvalues);
    const auto sets = findingsOf(run).summary.at("active_sets"),
               expected = findingsOf(one).summary.at("active_sets");
    ASSERT_EQ(sets.size(), expected.size());
    const auto &line = sets.at(0).at("followed").at(0), &same = expected.at(0).at("followed").at(0);
    for (const char* key : {"branches", "active_sets", "sturm_count_exact", "complete"})
      EXPECT_EQ(line.at(key), same.at(key)) << key;
    ASSERT_EQ(line.at("uncertain").size(), same.at("uncertain").size());
    for (std::size_t k = 0; k < line.at("uncertain").size(); ++k)
      EXPECT_EQ(line.at("uncertain").at(k).at("what"), same.at("uncertain").at(k).at("what"));
    for (std::size_t k = 1; k < sets.size(); ++k) EXPECT_FALSE(sets.at(k).contains("followed"));
  }
}

// A coefficient that falls with the speed gives each friction terms of its own. The eigenvalues are
// tracked at both ends of the interval of each set, where its state is that of the next set too,
// and so is every change of stability that a sweep through points within the intervals finds.
TEST(Tracking, EachSetHasTermsOfItsOwn) {
  const std::string falling = block +
                              "-modes_count 21 -flutter_track on -friction_law exponential "
                              "-friction_decay_speed 1 -friction_static_ratio 1.1 ";
  const ProgramRun points = runProgram("active_set/terms_at_points", 1,
                                       falling + "-flutter_friction 0,0.1,0.25,0.35,0.5,0.6");
  ASSERT_EQ(points.exitCode, 0) << points.error;
  const CsvTable wanted = readCsv(points.folder / "critical.csv");
  ASSERT_GE(wanted.column("friction").size(), 10U);
  for (const int ranks : {1, 2}) {
    const ProgramRun run = runProgram("active_set/terms_np" + std::to_string(ranks), ranks,
                                      falling + "-flutter_friction 0,0.6");
    ASSERT_EQ(run.exitCode, 0) << run.error;
    const auto line = findingsOf(run).summary.at("active_sets").at(0).at("followed").at(0);
    EXPECT_EQ(line.at("active_sets").size(), 4U);  // three nodes open, one after the other
    for (const auto& gap : line.at("uncertain"))
      EXPECT_EQ(gap.at("what").get<std::string>().find("no reduced problem"), std::string::npos)
          << gap;
    const CsvTable branches = readCsv(run.folder / "branches.csv");
    const auto friction = branches.column("friction"), branch = branches.column("branch");
    for (const double event : readCsv(run.folder / "contact_path.csv").column("friction")) {
      std::map<double, int> rows;  // [branch]
      for (std::size_t i = 0; i < friction.size(); ++i)
        if (std::abs(friction[i] - event) < 1e-9) ++rows[branch[i]];
      EXPECT_EQ(rows.size(), std::set<double>(branch.begin(), branch.end()).size()) << event;
      for (const auto& [number, count] : rows) EXPECT_EQ(count, 2) << "branch " << number;
    }
    const CsvTable found = readCsv(run.folder / "critical.csv");
    const auto here = found.column("friction"), there = wanted.column("friction");
    ASSERT_EQ(here.size(), there.size());
    // The tolerance of a critical friction is 1e-8; contact events are known to 1e-11 of a step.
    for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(here[i], there[i], 1e-7);
  }
}

/// Returns the frictions in critical.csv from the given one on.
std::vector<double> criticalFrom(const ProgramRun& run, double least) {
  std::vector<double> found;
  for (const double friction : readCsv(run.folder / "critical.csv").column("friction"))
    if (friction >= least) found.push_back(friction);
  return found;
}

// Below the first friction of a sweep the contact may not be that of its first point. The list then
// has the changes of stability from the first friction on, those of the sweep from 0, and the step
// below is named.
TEST(Tracking, BeginsWhereTheContactIsKnown) {
  const std::string options = block + "-modes_count 21 -flutter_friction ";
  const ProgramRun whole = runProgram("active_set/from_zero", 1, options + "0:0.7:0.1");
  ASSERT_EQ(whole.exitCode, 0) << whole.error;
  const auto events = readCsv(whole.folder / "contact_path.csv").column("friction");
  ASSERT_LT(std::ranges::min(events), 0.4);
  const auto wanted = criticalFrom(whole, 0.4);
  ASSERT_GE(wanted.size(), 2U);
  for (const auto& [ranks, more] :
       {std::pair(1, ""), std::pair(2, ""), std::pair(1, " -steady_full")}) {
    const ProgramRun run =
        runProgram("active_set/from_above_np" + std::to_string(ranks) + (*more ? "_full" : ""),
                   ranks, options + "0.4:0.7:0.1" + more);
    ASSERT_EQ(run.exitCode, 0) << run.error;
    EXPECT_NE(run.out.find("below the first friction of the sweep; begin the sweep at friction 0"),
              std::string::npos)
        << run.out;
    const auto all = criticalFrom(run, 0);
    if (*more) {  // the changes of contact are not located
      EXPECT_TRUE(all.empty() || all.front() >= 0.4);
      continue;
    }
    ASSERT_EQ(all.size(), wanted.size());
    // The tolerance of a critical friction is 1e-8; contact events are known to 1e-11 of a step.
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(all[i], wanted[i], 1e-7);
  }
}

// A point of the sweep where a node is about to open, which is known to 1e-11 of the step: its
// state belongs to the active sets before and after. The changes of stability are those of a sweep
// without this point. With the point moved by 1e-12, the node may count as open or as closed there.
TEST(Tracking, PassesPointsWhereTheContactChanges) {
  const std::string options = block + "-modes_count 21 -flutter_friction 0,";
  const ProgramRun plain = runProgram("active_set/no_point_at_change", 1, options + "0.6");
  ASSERT_EQ(plain.exitCode, 0) << plain.error;
  const auto events = readCsv(plain.folder / "contact_path.csv").column("friction");
  const auto wanted = criticalFrom(plain, 0);
  const auto frequencies = readCsv(plain.folder / "critical.csv").column("frequency_hz");
  ASSERT_GE(events.size(), 2U);
  const auto kinds = readCsv(plain.folder / "critical.csv").words("kind");
  ASSERT_GE(std::ranges::count(kinds, "contact"), 1);
  for (const double moved : {-1e-12, 0.0, 1e-12})
    for (const int ranks : {1, 2}) {
      const ProgramRun run = runProgram("active_set/point_at_change", ranks,
                                        options + formatted("%.17g,0.6", events[1] + moved));
      ASSERT_EQ(run.exitCode, 0) << run.error;
      const auto found = criticalFrom(run, 0);
      ASSERT_EQ(found.size(), wanted.size()) << run.out;
      // The tolerance of a critical friction is 1e-8; contact events are known to 1e-11 of a step.
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-7);
      EXPECT_EQ(readCsv(run.folder / "contact_path.csv").column("friction").size(), events.size());
      // Eigenvalues at changes of contact are corrected as well: their backward errors are known.
      // Those of two eigenvalues that meet are known to 1e-7.
      const CsvTable table = readCsv(run.folder / "critical.csv");
      const auto here = table.column("frequency_hz"), errors = table.column("backward_error");
      for (std::size_t i = 0; i < here.size(); ++i) {
        EXPECT_NEAR(here[i], frequencies[i], 1e-6 * here[i]);
        EXPECT_GT(errors[i], 0);
      }
      for (const double converged : readCsv(run.folder / "critical.csv").column("converged"))
        EXPECT_EQ(converged, 1);
    }
}

// With closed contact below it, a sweep that begins above 0 lists the changes from 0 on.
TEST(Tracking, BeginsAtZeroWhereTheContactStays) {
  const std::string options =
      "-mesh_set nx=6,ny_disc=2,ny_pad=2 -modes_count 15 -steady_uniqueness off "
      "-flutter_friction ";
  const auto fromZero = runCase("two_layers", options + "0,0.3,0.5"),
             fromAbove = runCase("two_layers", options + "0.3,0.5");
  const auto& wanted = fromZero.flutter.segments.at(0).trackedLines.at(0).criticals;
  const auto& found = fromAbove.flutter.segments.at(0).trackedLines.at(0).criticals;
  ASSERT_EQ(found.size(), wanted.size());
  ASSERT_FALSE(wanted.empty());
  EXPECT_LT(wanted.front().friction, 0.3);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i].friction, wanted[i].friction, 1e-7);
}

}  // namespace
}  // namespace squeal::test
