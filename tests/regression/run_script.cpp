// SPDX-License-Identifier: BSD-2-Clause
// scripts/run: cases of any folder, the ranks and cores of a run, its help.
#include <gtest/gtest.h>

#include "support/run/own_case.hpp"

namespace squeal::test {
namespace {

/// scripts/run in a folder where there is nothing to build: a setup that installs and builds
/// nothing, and the program of these tests.
fs::path scriptsIn(const fs::path& place) {
  fs::create_directories(place / "scripts/lib");
  fs::create_directories(place / "build");
  for (const char* script : {"run", "lib/run_case", "lib/ranks", "lib/report_dir"})
    fs::copy_file(fs::path(SQUEAL_SOURCE_DIR) / "scripts" / script, place / "scripts" / script);
  fs::create_symlink(SQUEAL_EXECUTABLE, place / "build/squeal");
  writeText(place / "scripts/setup",
            "cd \"$(dirname \"${BASH_SOURCE[0]}\")/..\"\n"
            "mpirun() { shift; '" SQUEAL_MPIEXEC "' \"$@\"; }\n");
  writeText(place / "scripts/squeal-plot", "#!/bin/sh\necho plotted\n");
  fs::permissions(place / "scripts/squeal-plot", fs::perms::owner_all);
  return place / "scripts/run";
}

TEST(CommandLine, ScriptRunsAnOptionsFileOfAnyFolder) {
  const fs::path place = ownCase("run_script/script"),
                 run = scriptsIn(placeFor("run_script/script") / "a clone");
  ASSERT_EQ(shell(place, "NP=1 '" + run.string() + "' './my case.yaml'" + small + " >out"), 0);
  EXPECT_TRUE(fs::exists(place / "results/my case/eigenvalues.csv"));
  EXPECT_NE(contentOf(place / "out").find("plotted"), std::string::npos);
  // Paths on the command line are those of the caller, not of the clone.
  fs::rename(place / "my layer.geo", place / "elsewhere.geo");
  EXPECT_EQ(shell(place, "NP=2 '" + run.string() +
                             "' 'my case.yaml' -mesh_file elsewhere.geo -report_dir 'my results'" +
                             small + " >out"),
            0);
  EXPECT_TRUE(fs::exists(place / "my results/eigenvalues.csv"));
  // The folder of the script replaces the one of the case, and a message reports it.
  writeText(place / "with folder.yaml",
            contentOf(place / "my case.yaml") + "report:\n  dir: mine\n");
  EXPECT_EQ(shell(place, "NP=1 '" + run.string() +
                             "' './with folder.yaml' -mesh_file elsewhere.geo" + small + " >out"),
            0);
  EXPECT_NE(
      contentOf(place / "out")
          .find("option -report_dir ./results/with folder replaces mine (./with folder.yaml, line"),
      std::string::npos)
      << contentOf(place / "out");
  EXPECT_EQ(shell(place, "'" + run.string() + "' nosuch.yaml 2>err"), 1);
  EXPECT_NE(contentOf(place / "err").find("no options file 'nosuch.yaml'"), std::string::npos);
}

// Without scripts/setup beside it, the script can neither install nor build.
// More ranks than cores share these, unbound, and give way when they wait; fewer have BLAS threads.
TEST(CommandLine, ScriptSharesOutTheCores) {
  const auto holds = [](const std::string& ranks, const std::string& condition) {
    return shell("/", "env -i PATH=\"$PATH\" NP=" + ranks +
                          " bash -euc '. \"" SQUEAL_SOURCE_DIR
                          "/scripts/lib/ranks\"; cores=$(physical_cores); choose_ranks; [ " +
                          condition + " ]'") == 0;
  };
  const std::string crowded =
      "\"${OMPI_MCA_mpi_yield_when_idle:-0}${OMPI_MCA_rmaps_base_oversubscribe:-0}"
      "${OMPI_MCA_hwloc_base_binding_policy:-0}$OPENBLAS_NUM_THREADS\" = 11none1";
  EXPECT_TRUE(holds("100000", crowded));
  EXPECT_TRUE(holds("1", "\"${OMPI_MCA_mpi_yield_when_idle:-0}\" = 0"));
  EXPECT_TRUE(holds("1", "\"$OPENBLAS_NUM_THREADS\" -eq \"$cores\""));
  EXPECT_TRUE(holds("", "\"$NP\" -le \"$cores\""));
}

TEST(CommandLine, ScriptHelpBuildsNothing) {
  const fs::path place = placeFor("run_script/help");
  fs::remove_all(place);
  fs::create_directories(place / "scripts/lib");
  for (const char* script : {"run", "lib/run_case"})
    fs::copy_file(fs::path(SQUEAL_SOURCE_DIR) / "scripts" / script, place / "scripts" / script);
  for (const char* call : {"scripts/run --help >out", "scripts/run disc_brake -h >out"}) {
    EXPECT_EQ(shell(place, call), 0) << call;
    EXPECT_NE(contentOf(place / "out").find("scripts/run [CASE]"), std::string::npos) << call;
  }
}

}  // namespace
}  // namespace squeal::test
