// SPDX-License-Identifier: BSD-2-Clause
/// main() of every test program: one session for all its tests, one verdict for all ranks.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>
#include <string>

#include "base/session/session.hpp"
#include "base/session/stages.hpp"
#include "base/system/blas_kernel.hpp"

namespace {

/// What the ranks other than 0 say: their failures, nothing else.
class FailurePrinter : public testing::EmptyTestEventListener {
 public:
  explicit FailurePrinter(int rank) : rank_(rank) {}

 private:
  // googletest holds its lock while it reports a failure: the current test cannot be asked for
  // then, it is noted before.
  void OnTestStart(const testing::TestInfo& test) override {
    test_ = std::string(test.test_suite_name()) + "." + test.name();
  }
  void OnTestEnd(const testing::TestInfo&) override { test_ = "outside the tests"; }
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    std::fprintf(stderr, "[rank %d] %s: %s:%d: %s\n", rank_, test_.c_str(),
                 result.file_name() ? result.file_name() : "?", result.line_number(),
                 result.message());
  }
  int rank_;
  std::string test_ = "outside the tests";
};

void silence(int rank) {
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());
  delete listeners.Release(listeners.default_xml_generator());  // one report, written by rank 0
  listeners.Append(new FailurePrinter(rank));
}

}  // namespace

int main(int argc, char** argv) {
  squeal::restartWithBlasKernel(argv);
  testing::InitGoogleTest(&argc, argv);
  squeal::Session session(argc, argv);
  squeal::setQuiet(true);
  if (session.rank() != 0) silence(session.rank());
  int failed = RUN_ALL_TESTS();
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 0)
    failed = 1;  // a program without a test, or a filter that none passes, proves nothing
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, session.comm());
  if (failed != 0 && session.rank() == 0)
    std::printf("FAILED on at least one of %d ranks\n", session.size());
  return failed;
}
