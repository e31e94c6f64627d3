// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Runs for which the disc is full: by a limit of one rank, or on a small file system of their own.
#include "support/harness/earlier_results.hpp"

namespace squeal::test {

/// From a stage on, files of a rank cannot grow beyond some bytes: EFBIG, where a full disc gives
/// ENOSPC.
struct Limit {
  const char* name;
  const char* stage;
  int rank;
  rlim_t bytes;
  const char*
      file;  ///< whose name ends so is the one that cannot be written; it may be any of several
};

/// The line of an error, and nothing of the libraries; what else mpirun says of the exit code is
/// its own.
inline void expectOneLine(const std::string& error, const std::string& end) {
  const auto begin = error.find("squeal: error: option -report_dir: cannot write ");
  ASSERT_NE(begin, std::string::npos) << error;
  const std::string line = error.substr(begin, error.find('\n', begin) - begin);
  EXPECT_TRUE(line.ends_with(end)) << line;
  EXPECT_EQ(error.find("squeal: ", begin + 1), std::string::npos)
      << "said more than once: " << error;
  for (const char* trace : {"HDF5-DIAG", "PETSC ERROR", "vtk", "terminate called"})
    EXPECT_EQ(error.find(trace, error.find('\n', begin)), std::string::npos) << error;
}

inline void expectLimitExplained(const Limit& limit) {
  const std::string name = placeOf(std::string("limit_") + limit.name);
  SCOPED_TRACE(name);
  const fs::path folder = copyOfEarlier(name);
  const Files before = filesIn(folder);
  // On a slow machine the run would be worth a checkpoint, which stays when it fails.
  Started run(name, 2, commandLine(with(slow, {{"checkpoint", "off"}})));
  ASSERT_TRUE(run.reached(limit.stage));
  const rlimit most{limit.bytes, RLIM_INFINITY};
  ASSERT_EQ(prlimit(run.rank(limit.rank), RLIMIT_FSIZE, &most, nullptr), 0);
  const ProgramRun ended = run.finished();
  EXPECT_EQ(ended.exitCode, 1) << "124: it hangs";
  expectOneLine(ended.error, std::string(limit.file) + ": File too large");
  EXPECT_EQ(differing(before, filesIn(folder)), none);
}

/// Whether a file system can be mounted for a process alone: as root, or in a user namespace.
inline bool canMount() {
  const fs::path place = placeFor(placeOf("mount"));
  fs::create_directories(place);
  return std::system(("unshare --mount --map-root-user mount -t tmpfs none '" + place.string() +
                      "' 2>/dev/null")
                         .c_str()) == 0;
}

/// Kilobytes that files take on a file system with pages of 4.
inline std::size_t kilobytes(const Files& files) {
  std::size_t sum = 0;
  for (const auto& [name, content] : files) sum += (content.size() + 4095) / 4096 * 4;
  return sum;
}

/// A run with its folder on a file system of so many kilobytes, which holds `before`; it is gone
/// with the run.
struct OnSmallDisc {
  int exitCode = -1;
  std::string error;
  Files after;

  OnSmallDisc(const std::string& name, int ranks, std::size_t size, const fs::path& before,
              const Options& options) {
    const fs::path place = placeFor(name);
    fs::remove_all(place);
    for (const char* folder : {"disc", "after"}) fs::create_directories(place / folder);
    const std::string script =
        "mount -t tmpfs -o size=" + std::to_string(size) + "k none disc && mkdir disc/results && " +
        (before.empty() ? "" : "cp -r '" + before.string() + "'/. disc/results && ") +
        "cd disc && find '" SQUEAL_SOURCE_DIR
        "' -mindepth 1 -maxdepth 1 ! -name results ! -name '.*' "
        "-exec ln -s '{}' . ';' && " +
        "'" SQUEAL_MPIEXEC "' " + std::to_string(ranks) + " '" SQUEAL_EXECUTABLE "' " +
        commandLine(options) +
        " -report_dir results 2>../stderr.txt >../stdout.txt; code=$?; cp -r results/. ../after; "
        "exit $code";
    writeText(place / "run.sh", script);
    const std::string command = "cd '" + place.string() +
                                "' && timeout -k 5 60 unshare --mount --map-root-user sh ./run.sh";
    const int status = std::system(command.c_str());
    exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    error = contentOf(place / "stderr.txt");
    after = filesIn(place / "after");
  }
};

/// Room for this fraction of the new results, whose number of files depends on the ranks, beside
/// the earlier ones.
inline void expectFullDiscExplained(int ranks, double fraction) {
  const std::string name = placeOf("disc_" + shortest(fraction) + "_np" + std::to_string(ranks));
  SCOPED_TRACE(name);
  const ProgramRun whole = runProgram(name + "_whole", ranks, commandLine(layer), 60);
  ASSERT_EQ(whole.exitCode, 0) << whole.error;
  const Files before = filesIn(earlierResults());
  const double room = fraction * static_cast<double>(kilobytes(filesIn(whole.folder)));
  const OnSmallDisc run(name, ranks, kilobytes(before) + static_cast<std::size_t>(room) / 4 * 4,
                        earlierResults(), layer);
  EXPECT_EQ(run.exitCode, 1) << "124: it hangs";
  expectOneLine(run.error, ": No space left on device");
  EXPECT_EQ(differing(before, run.after), none);
}

}  // namespace squeal::test
