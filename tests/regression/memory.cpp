// SPDX-License-Identifier: BSD-2-Clause
// Wherever memory runs out, the program reports it in one line: no trace, no stall, no results.
#include <gtest/gtest.h>

#include "support/harness/bad_input.hpp"

namespace squeal::test {
namespace {

struct Limited {
  int ranks, megabytes;
  const char* message;
};

/// The program on a mesh of 53,000 unknowns, each rank with so many addresses.
ProgramRun runLimited(const Limited& limited) {
  const std::string name =
      "memory/np" + std::to_string(limited.ranks) + "_" + std::to_string(limited.megabytes);
  fs::remove_all(placeFor(name));
  const fs::path shell = placeFor(name) / "limited";
  writeText(shell, "#!/bin/sh\nulimit -v " + std::to_string(1024 * limited.megabytes) +
                       "\nexec '" SQUEAL_EXECUTABLE "' \"$@\"\n");
  fs::permissions(shell, fs::perms::owner_all);
  return runAgain(name, limited.ranks,
                  "-options_file options/disc_brake.yaml -flutter_friction 0.4 -quiet", 100,
                  shell.string(), secondToEnd);
}

// Libraries take some 250 MB of addresses, the case more than 1 GB on one rank: in between the
// run ends, by an allocation of PETSc, of the C++ library, or of MUMPS. OpenBLAS, which asks for
// ever, has its 128 MB before anything else.
TEST(Memory, TooLittleIsToldInOneLine) {
  for (const Limited& limited : {Limited{1, 330, "is out of memory"},
                                 {1, 710, "MUMPS is out of memory"},
                                 {1, 870, "is out of memory"},
                                 {2, 640, "is out of memory"}}) {
    SCOPED_TRACE(std::to_string(limited.ranks) + " ranks of " + std::to_string(limited.megabytes) +
                 " MB");
    const ProgramRun run = runLimited(limited);
    EXPECT_EQ(run.exitCode, 1) << "124: it hangs";
    EXPECT_NE(messageOf(run).find(limited.message), std::string::npos) << run.error.substr(0, 500);
    for (const char* trace : {"PETSC ERROR", "bad_alloc", "terminate called"})
      EXPECT_EQ(run.error.find(trace), std::string::npos) << run.error.substr(0, 500);
    EXPECT_FALSE(fs::exists(run.folder / "summary.json"));
  }
}

}  // namespace
}  // namespace squeal::test
