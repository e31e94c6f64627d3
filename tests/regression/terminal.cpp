// SPDX-License-Identifier: BSD-2-Clause
// What a run prints: the log and its table, the manual, nothing if it is quiet, a profile.
#include <regex>

#include "base/options/options.hpp"
#include "support/harness/same_on_ranks.hpp"
#include "support/run/layer_run.hpp"

namespace squeal::test {
namespace {

/// One run that several tests read.
const ProgramRun& layerRun() {
  static const ProgramRun run = runLayer("terminal", "-report_fields off");
  return run;
}

TEST(Outputs, TerminalTable) {
  for (const char* stage :
       {"mesh", "elasticity", "contact", "steady", "modes", "flutter", "report"})
    EXPECT_NE(("\n" + layerRun().out).find("\n" + std::string(stage) + " "), std::string::npos)
        << stage;
  const auto begin = layerRun().out.find("friction  unstable modes");
  ASSERT_NE(begin, std::string::npos) << layerRun().out;
  const auto zero = layerRun().out.find("\n       0  none: steady sliding is stable", begin),
             low = layerRun().out.find("\n     0.2  ", begin),
             high = layerRun().out.find("\n     0.4  ", begin);
  ASSERT_NE(zero, std::string::npos) << layerRun().out;
  ASSERT_NE(low, std::string::npos);
  ASSERT_NE(high, std::string::npos);
  EXPECT_TRUE(zero < low && low < high) << "not by friction";
}

TEST(Outputs, Help) {
  for (int ranks : {1, 2}) {
    const ProgramRun run = runProgram("terminal/help_np" + std::to_string(ranks), ranks, "-help");
    EXPECT_EQ(run.exitCode, 0) << run.error;
    EXPECT_EQ(run.error, "");
    EXPECT_FALSE(fs::exists(run.folder));
    ASSERT_GE(Option::all().size(), 25U);
    for (const auto* option : Option::all()) {
      const auto line = run.out.find("\n  -" + option->name + " ");
      EXPECT_NE(line, std::string::npos) << option->name;
      EXPECT_EQ(run.out.find("\n  -" + option->name + " ", line + 1), std::string::npos)
          << option->name << " twice";
      const std::string text = run.out.substr(line + 1, run.out.find('\n', line + 1) - line - 1);
      EXPECT_NE(text.find(option->meaning), std::string::npos) << text;
      EXPECT_NE(text.find("[" + option->unit + "]"), option->unit.empty() ? 0 : std::string::npos)
          << text;
      EXPECT_TRUE(text.find("(default ") != std::string::npos ||
                  text.find("(required") != std::string::npos)
          << text;
    }
    EXPECT_FALSE(SolverPrefix::all().empty());
    for (const auto* solver : SolverPrefix::all())
      EXPECT_NE(run.out.find("-" + solver->prefix + "*"), std::string::npos) << solver->prefix;
  }
}

TEST(Outputs, Quiet) {
  const ProgramRun run = runProgram(
      "terminal/quiet", 2, coarseLayer + "-flutter_friction 0.4 -quiet -report_fields off");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.error, "");
  EXPECT_TRUE(fs::exists(run.folder / "summary.json"));
}

// PETSc's own profile names the stages of the method, and the kinds of work that are not PETSc's.
TEST(Outputs, ProfileOfPetsc) {
  const fs::path profile = placeFor("terminal") / "profile.txt";
  fs::create_directories(profile.parent_path());
  const auto run =
      runProgram("terminal/profile", 1,
                 coarseLayer + frictions + "-report_fields off -log_view :" + profile.string());
  ASSERT_EQ(run.exitCode, 0) << run.error;
  const std::string text = contentOf(profile);
  for (const std::string stage :
       {"mesh", "elasticity", "contact", "factor", "steady", "modes", "flutter"})
    EXPECT_TRUE(std::regex_search(text, std::regex("\n *\\d+: +" + stage + ": "))) << stage;
  for (const char* work : {"BlockSolve", "BlockProduct", "InnerProduct", "DenseEigen", "Sketch"})
    EXPECT_NE(text.find("\n" + std::string(work)), std::string::npos) << work;
}

}  // namespace
}  // namespace squeal::test
