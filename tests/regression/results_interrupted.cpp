// SPDX-License-Identifier: BSD-2-Clause
// Every way to end a run at five moments of it: the earlier results stay as they were, no process
// is left, the next run works.
#include "support/harness/full_disc.hpp"

namespace squeal::test {
namespace {

constexpr std::array<const char*, 5> moments{"mesh", "elasticity", "steady", "modes", "report"};

void expectKeptAtAllMoments(const std::string& name, int signal, int rank) {
  for (const char* moment : moments)
    expectKept({(name + "_at_" + moment).c_str(), signal, rank, moment});
}

TEST(ResultsInterrupted, KillOfRank0) { expectKeptAtAllMoments("kill_0", SIGKILL, 0); }
TEST(ResultsInterrupted, KillOfRank1) { expectKeptAtAllMoments("kill_1", SIGKILL, 1); }
TEST(ResultsInterrupted, Terminate) { expectKeptAtAllMoments("terminate", SIGTERM, -1); }
TEST(ResultsInterrupted, TerminateOneRank) { expectKeptAtAllMoments("terminate_1", SIGTERM, 1); }
TEST(ResultsInterrupted, Interrupt) { expectKeptAtAllMoments("interrupt", SIGINT, -1); }
TEST(ResultsInterrupted, HangUp) { expectKeptAtAllMoments("hang_up", SIGHUP, 0); }

TEST(ResultsInterrupted, FullDisc) {
  for (const char* moment : moments)
    for (int rank : {0, 1})
      expectLimitExplained(
          {(std::string(moment) + "_" + std::to_string(rank)).c_str(), moment, rank, 0, ""});
  if (!canMount()) GTEST_SKIP() << "a file system cannot be mounted here (unshare --mount)";
  for (int ranks : {1, 2, 3})
    for (double fraction : {0.02, 0.2, 0.4, 0.6, 0.8, 0.99})
      expectFullDiscExplained(ranks, fraction);
}

}  // namespace
}  // namespace squeal::test
