// SPDX-License-Identifier: BSD-2-Clause
// The program squeal_gmsh, which reads meshes: if it is missing, cannot start, dies or belongs to
// another version, the run ends with an error that names the mesh and the cause.
#include <gtest/gtest.h>

#include "support/harness/bad_input.hpp"

namespace squeal::test {
namespace {

const std::string reader = fs::path(SQUEAL_EXECUTABLE).parent_path() / "squeal_gmsh";

/// Runs a copy of the program in a folder where `reader` is its reader; an empty text: none.
ProgramRun runWith(const std::string& name, int ranks, const std::string& script,
                   fs::perms permissions = fs::perms::owner_all) {
  const fs::path folder = placeFor("mesh_reader/" + name + "_np" + std::to_string(ranks));
  fs::remove_all(folder);
  fs::create_directories(folder / "bin");
  const fs::path program = folder / "bin" / "squeal";
  fs::create_hard_link(SQUEAL_EXECUTABLE, program);
  if (!script.empty()) {
    writeText(folder / "bin" / "squeal_gmsh", script);
    fs::permissions(folder / "bin" / "squeal_gmsh", permissions);
  }
  return runAgain("mesh_reader/" + name + "_np" + std::to_string(ranks), ranks,
                  "-options_file options/layer.yaml -dry_run", 60, program.string());
}

void expectError(const ProgramRun& run, const std::vector<std::string>& words) {
  EXPECT_EQ(run.exitCode, 1) << "124: it hangs";
  const std::string message = messageOf(run);
  EXPECT_EQ(message.find("option -mesh_file meshes/layer.geo: "), 0u) << run.error.substr(0, 500);
  for (const auto& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << word << "\n" << run.error.substr(0, 500);
}

TEST(MeshReader, AFaultOfTheProgramIsAnError) {
  struct Case {
    const char *name, *script;
    std::vector<std::string> words;
  };
  for (const Case& fault :
       {Case{"missing", "", {"'squeal_gmsh'", "is not in", "install"}},
        {"interpreter", "#!/nowhere/sh\n", {"squeal_gmsh'", "No such file"}},
        {"killed", "#!/bin/sh\nkill -9 $$\n", {"gmsh was killed"}},
        {"crashed", "#!/bin/sh\nkill -11 $$\n", {"gmsh crashed (Segmentation fault)"}},
        {"exits", "#!/bin/sh\nexit 3\n", {"gmsh exited with code 3"}},
        {"halfway", "#!/bin/sh\nprintf '\\000'\n", {"gmsh exited with code 0"}},
        {"unloadable", "#!/bin/sh\nexit 127\n", {"squeal_gmsh' cannot be loaded", "libraries"}}})
    for (const int ranks : {1, 2}) {
      SCOPED_TRACE(std::string(fault.name) + " on " + std::to_string(ranks) + " ranks");
      expectError(runWith(fault.name, ranks, fault.script), fault.words);
    }
  expectError(runWith("forbidden", 1, "#!/bin/sh\n", fs::perms::owner_read),
              {"cannot start the program", "squeal_gmsh'", "Permission denied"});
}

// An installation: the reader is in the folder of internal programs, and the command is a link.
TEST(MeshReader, IsFoundInAnInstallation) {
  const fs::path folder = placeFor("mesh_reader/installed");
  fs::remove_all(folder);
  fs::create_directories(folder / "bin");
  fs::create_directories(folder / "libexec/squeal");
  fs::create_hard_link(SQUEAL_EXECUTABLE, folder / "bin/squeal");
  fs::create_hard_link(reader, folder / "libexec/squeal/squeal_gmsh");
  fs::create_symlink("bin/squeal", folder / "program");
  const ProgramRun run =
      runAgain("mesh_reader/installed", 1, "-options_file options/layer.yaml -dry_run", 60,
               (folder / "program").string());
  EXPECT_EQ(run.exitCode, 0) << run.error;
}

// Anything but a job of the same version is refused.
TEST(MeshReader, RefusesOtherInput) {
  const fs::path folder = placeFor("mesh_reader/input");
  fs::create_directories(folder);
  for (const char* input : {"", "job of squeal 0.0.0"}) {
    writeText(folder / "job", input);
    const std::string command = "'" + reader + "' <'" + (folder / "job").string() + "' >'" +
                                (folder / "answer").string() + "'";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
    EXPECT_NE(contentOf(folder / "answer").find("cannot read its job"), std::string::npos);
  }
}

}  // namespace
}  // namespace squeal::test
