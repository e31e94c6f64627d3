// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Results of an earlier run with files of the user among them, and what is expected of them after
/// something has happened to a run.
#include <sys/resource.h>

#include <algorithm>
#include <future>

#include "support/harness/bad_input.hpp"
#include "support/harness/folder_files.hpp"
#include "support/harness/running_program.hpp"

namespace squeal::test {

/// Test programs run at the same time: each has its places in a folder of its own.
inline std::string placeOf(const std::string& name) {
  return fs::read_symlink("/proc/self/exe").filename().string() + "/" + name;
}

inline const Files mine{{"vtk/mine.vtu", "mine"},
                        {"options_copy.txt", "mine"},
                        {"stability_mine.png", "mine"},
                        {"steady_notes.csv", "mine"},
                        {"pictures/squeal.txt", "mine"}};

/// A folder of results with files of the user among them, made once and copied.
inline const fs::path& earlierResults() {
  static const fs::path folder = [] {
    const ProgramRun run = runProgram(placeOf("earlier"), 2, commandLine(layer), 60);
    if (run.exitCode != 0) throw std::runtime_error(run.error);
    put(run.folder, mine);
    return run.folder;
  }();
  return folder;
}

/// The same in a place of its own.
inline fs::path copyOfEarlier(const std::string& name) {
  const fs::path from = earlierResults();
  fs::remove_all(placeFor(name));
  fs::create_directories(placeFor(name));
  fs::copy(from, placeFor(name) / "results", fs::copy_options::recursive);
  return placeFor(name) / "results";
}

/// The files that a manifest lists, itself among them.
inline std::vector<std::string> listed(const fs::path& folder) {
  std::vector<std::string> names;
  std::istringstream text(contentOf(folder / "manifest.txt"));
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line))
    if (line.back() != '/') names.push_back(line);
  return names;
}

inline void expectOnly(const fs::path& folder, const std::vector<std::string>& results,
                       const Files& ofTheUser) {
  Files files = filesIn(folder);
  for (const auto& [name, content] : ofTheUser) {
    EXPECT_EQ(files.count(name) ? files[name] : "gone", content) << name;
    files.erase(name);
  }
  std::vector<std::string> expected = results;
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(namesOf(files), expected);
}

/// A run with distinguishable stages. Its fields take several seconds, since mpirun forwards a
/// signal only after one.
inline const Options slow =
    with(without(layer, {"quiet"}),
         {{"mesh_set", "nx=60,ny=20"}, {"modes_count", "40"}, {"report_frames", "600"}});

struct Ending {
  const char* name;
  int signal, rank;  ///< -1: mpirun
  const char* stage;
};

/// Ends a run after the first line of a stage, and expects the earlier results as they were; then
/// the next run works.
inline void expectKept(const Ending& ending) {
  const std::string name = placeOf(ending.name);
  SCOPED_TRACE(name);
  const fs::path folder = copyOfEarlier(name);
  const Files before = filesIn(folder);
  Started run(name, 2, commandLine(slow));
  ASSERT_TRUE(run.reached(ending.stage));
  ASSERT_EQ(kill(ending.rank < 0 ? run.mpirun() : run.rank(ending.rank), ending.signal), 0);
  const ProgramRun ended = run.finished();
  EXPECT_NE(ended.exitCode, 0);
  EXPECT_NE(ended.exitCode, 124) << "it hangs";
  EXPECT_EQ(ended.error.find("PETSC ERROR"), std::string::npos) << ended.error;
  EXPECT_EQ(ended.error.find("a defect of the program") != std::string::npos,
            ending.signal == SIGABRT)
      << ended.error;
  Files after = filesIn(folder);
  std::erase_if(after, [](const auto& file) { return file.first.starts_with("interrupted/"); });
  EXPECT_EQ(differing(before, after), none);
  const ProgramRun again = runAgain(name, 1, commandLine(layer), 60);
  EXPECT_EQ(again.exitCode, 0) << again.error;
  expectOnly(folder, listed(folder), mine);
}

}  // namespace squeal::test
