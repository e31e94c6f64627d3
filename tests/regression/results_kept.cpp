// SPDX-License-Identifier: BSD-2-Clause
// Results of an earlier run, and files of the user, against everything that can happen to a run.
#include <nlohmann/json.hpp>

#include "support/harness/earlier_results.hpp"

namespace squeal::test {
namespace {

// --- what goes and what stays ---

// It was emptied before the options were even read.
TEST(ResultsKept, WhenARunFails) {
  const std::vector<std::pair<std::string, Options>> failing{
      {"mistyped", with(layer, {{"flutter_frictions", "0.2"}})},
      {"value", with(layer, {{"material_layer_density", "-1"}})},
      {"no_mesh", with(layer, {{"mesh_file", "meshes/nosuch.geo"}})},
      {"late",
       with(layer, {{"modes_count", "100000"}})}};  // known when the mesh is read and assembled
  std::vector<std::future<void>> runs;
  const Files before = filesIn(earlierResults());
  for (const auto& [name, options] : failing)
    runs.push_back(
        std::async(std::launch::async, [&, name = placeOf("failing_" + name), options = options] {
          const fs::path folder = copyOfEarlier(name);
          const ProgramRun run = runAgain(name, 2, commandLine(options), 60);
          EXPECT_EQ(run.exitCode, 1) << name << run.error;
          EXPECT_EQ(differing(before, filesIn(folder)), none) << name;
        }));
  for (auto& run : runs) run.get();
}

TEST(ResultsKept, NoFolderIsMadeForARunThatFails) {
  const std::string name = placeOf("none");
  const ProgramRun run =
      runProgram(name, 2, commandLine(with(layer, {{"modes_count", "100000"}})), 60);
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_FALSE(fs::exists(run.folder));
}

TEST(ResultsKept, ReplacedByExactlyThoseOfTheNewRun) {
  const std::string name = placeOf("replaced");
  const fs::path folder = copyOfEarlier(name);
  ProgramRun run = runAgain(name, 1, commandLine(with(layer, {{"flutter_friction", "0.1"}})), 60);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  expectOnly(folder, listed(folder), mine);
  EXPECT_TRUE(fs::exists(folder / "steady_0.1.csv"));
  EXPECT_FALSE(fs::exists(folder / "steady_0.2.csv"));
  EXPECT_FALSE(fs::exists(folder / "vtk" / "steady_friction_0.2.pvtu"));
  EXPECT_EQ(nlohmann::json::parse(contentOf(folder / "summary.json")).at("ranks"), 1);
  // Without fields vtk/ holds nothing but the user's file, and takes fields again later.
  run = runAgain(name, 1, commandLine(with(layer, {{"report_fields", "off"}})), 60);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  expectOnly(folder, listed(folder), mine);
  EXPECT_FALSE(fs::exists(folder / "results.h5"));
  run = runAgain(name, 1, commandLine(layer), 60);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  expectOnly(folder, listed(folder), mine);
  EXPECT_EQ(listed(folder).size(), filesIn(folder).size() - mine.size());
}

// Without its manifest nothing shows which files are those of a run.
TEST(ResultsKept, OfAFolderWithoutItsManifest) {
  const std::string name = placeOf("unlisted");
  const fs::path folder = copyOfEarlier(name);
  fs::remove(folder / "manifest.txt");
  const Files before = filesIn(folder);
  const ProgramRun run =
      runAgain(name, 1, commandLine(with(layer, {{"flutter_friction", "0.1"}})), 60);
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_NE(run.error.find("option -report_dir"), std::string::npos) << run.error;
  EXPECT_EQ(differing(before, filesIn(folder)), none);
}

// What has the name of a result and is of no run: an error before work begins, which a line of the
// stage would show.
TEST(ResultsKept, NothingOfTheUserIsOverwritten) {
  std::vector<std::future<void>> runs;
  for (const std::string file :
       {"options.txt", "vtk/mine.vtu", "steady_0.2.csv", "results.h5/mine", "summary.json"})
    runs.push_back(std::async(std::launch::async, [file] {
      const std::string name = placeOf("in_the_way_" + fs::path(file).begin()->string());
      fs::remove_all(placeFor(name));
      put(placeFor(name) / "results", {{file, "mine"}});
      const ProgramRun run = runAgain(name, 2, commandLine(without(layer, {"quiet"})), 60);
      EXPECT_EQ(run.exitCode, 1) << file;
      const std::string message = messageOf(run);
      EXPECT_NE(message.find("option -report_dir: "), std::string::npos) << run.error;
      EXPECT_NE(message.find((run.folder / *fs::path(file).begin()).string() + " is in the way"),
                std::string::npos)
          << run.error;
      EXPECT_EQ(run.out, "") << file;
      EXPECT_EQ(filesIn(run.folder), (Files{{file, "mine"}}));
    }));
  for (auto& run : runs) run.get();
}

// --- two at a time ---

TEST(ResultsKept, OneRunAtATimeInAFolder) {
  const std::string name = placeOf("two");
  const fs::path folder = copyOfEarlier(name);
  Started one(name, 2, commandLine(with(slow, {{"report_frames", "60"}})));
  ASSERT_TRUE(one.printed("elasticity"));
  fs::create_directories(placeFor(placeOf("second")));
  const fs::path error = placeFor(placeOf("second")) / "stderr.txt";
  const std::string command = "cd '" SQUEAL_SOURCE_DIR "' && '" SQUEAL_MPIEXEC
                              "' 2 '" SQUEAL_EXECUTABLE "' " +
                              commandLine(layer) + " -report_dir '" + folder.string() +
                              "/../results' 2>'" + error.string() + "'";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(contentOf(error).find("squeal: error: option -report_dir: another run is writing to "),
            std::string::npos)
      << contentOf(error);
  const ProgramRun run = one.finished();
  EXPECT_EQ(run.exitCode, 0) << run.error;
  expectOnly(folder, listed(folder), mine);
}

// --- a run that is ended ---

// mpirun leaves the ranks one second to remove what they have written. The run with most files has
// no other run beside it.
TEST(ResultsKept, WhenARunIsEnded) {
  earlierResults();
  std::vector<std::future<void>> runs;
  for (const Ending& ending :
       {Ending{"kill_rank_0", SIGKILL, 0, "report"},
        Ending{"kill_rank_1", SIGKILL, 1, "elasticity"}, Ending{"terminate", SIGTERM, -1, "modes"},
        Ending{"abort", SIGABRT, 1,
               "modes"}})  // as the allocator does where it finds a damaged heap
    runs.push_back(std::async(std::launch::async, expectKept, ending));
  for (auto& run : runs) run.get();
  expectKept({"interrupt", SIGINT, -1, "report"});
}

}  // namespace
}  // namespace squeal::test
