// SPDX-License-Identifier: BSD-2-Clause
// A disc that is full: one line and exit code 1 on any number of ranks, the earlier results as they
// were, nothing of the new ones left.
#include <cstring>

#include "support/harness/full_disc.hpp"

namespace squeal::test {
namespace {

// The file size is limited for only one rank, while the others can write: none waits for it.
TEST(DiscFull, OfOneRankAlone) {
  earlierResults();
  std::vector<std::future<void>> runs;
  for (const Limit& limit :
       {Limit{"first_file", "modes", 0, 0, "eigenvalues.csv"},
        Limit{"hdf5", "modes", 0, 60000, "results.h5"}, Limit{"piece", "modes", 1, 0, "_1.vtu"},
        Limit{"later_piece", "report", 1, 0, "_1.vtu"}})
    runs.push_back(std::async(std::launch::async, expectLimitExplained, limit));
  for (auto& run : runs) run.get();
}

// Half of the results fit, and almost all of them.
TEST(DiscFull, OfAFileSystem) {
  if (!canMount()) GTEST_SKIP() << "a file system cannot be mounted here (unshare --mount)";
  for (double fraction : {0.5, 0.97}) expectFullDiscExplained(2, fraction);
}

TEST(DiscFull, ForExportedMatrices) {
  if (!canMount()) GTEST_SKIP() << "a file system cannot be mounted here (unshare --mount)";
  for (const char* format : {"petsc", "matrix_market"}) {
    const std::string name = placeOf(std::string("export_") + format);
    const OnSmallDisc run(
        name, 2, 16, {},
        with(layer, {{"report_matrices", "results/matrices"}, {"report_matrices_format", format}}));
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_NE(
        run.error.find("squeal: error: option -report_matrices results/matrices: cannot write "),
        std::string::npos)
        << run.error;
    EXPECT_NE(run.error.find(": No space left on device\n"), std::string::npos) << run.error;
    EXPECT_EQ(run.error.find("PETSC ERROR"), std::string::npos) << run.error;
    EXPECT_EQ(run.after, Files{});
  }
}

// No results are lost if the terminal cannot be written. A reader that closes the pipe early, as
// head does, is not an error.
TEST(DiscFull, OfTheStandardOutput) {
  struct Output {
    const char *name, *where;
    int exitCode;
    const char* message;
  };
  for (const Output& output :
       {Output{"full", ">/dev/full; exit $?", 1,
               "squeal: error: cannot write to the standard output: No space left"},
        Output{"closed", "| head -n 1 >/dev/null; exit ${PIPESTATUS[0]}", 0, ""}}) {
    const std::string name = placeOf(std::string("output_") + output.name);
    fs::remove_all(placeFor(name));
    fs::create_directories(placeFor(name));
    const fs::path folder = placeFor(name) / "results", error = placeFor(name) / "stderr.txt";
    writeText(placeFor(name) / "run.sh", "cd '" SQUEAL_SOURCE_DIR "' && '" SQUEAL_EXECUTABLE "' " +
                                             commandLine(without(layer, {"quiet"})) +
                                             " -report_dir '" + folder.string() + "' 2>'" +
                                             error.string() + "' " + output.where + "\n");
    // without mpirun, which would stand between the program and its output
    const int status = std::system(
        ("env -i PATH=\"$PATH\" bash '" + (placeFor(name) / "run.sh").string() + "'").c_str());
    EXPECT_EQ(WEXITSTATUS(status), output.exitCode) << contentOf(error);
    EXPECT_EQ(contentOf(error).substr(0, std::strlen(output.message)), output.message);
    EXPECT_EQ(contentOf(error).empty(), output.exitCode == 0) << contentOf(error);
    expectOnly(folder, listed(folder), {});
  }
}

}  // namespace
}  // namespace squeal::test
