// SPDX-License-Identifier: BSD-2-Clause
// When an entry of a checkpoint is due, and what work is worth one.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "base/checkpoint/checkpoint.hpp"
#include "support/harness/scratch_folder.hpp"

namespace squeal::checkpoint {
namespace {

Checkpoint every(double interval, const test::Folder& folder) {
  return {PETSC_COMM_WORLD,
          folder.path / "interrupted" / "checkpoint",
          {{"a", "1"}},
          {.interval = interval}};
}

// A sixth of the interval.
TEST(Checkpoint, IsWorthWorkOfASixthOfTheInterval) {
  const test::Folder folder;
  const Checkpoint checkpoint = every(60, folder);
  EXPECT_TRUE(checkpoint.isWorth(10));
  EXPECT_FALSE(checkpoint.isWorth(9.99));
  EXPECT_TRUE(every(0, folder).isWorth(0));
}

// One that is disabled writes nothing, whatever the work.
TEST(Checkpoint, IsNeverDueIfDisabled) {
  Checkpoint none;
  EXPECT_FALSE(none.due());
  EXPECT_FALSE(none.isWorth(1e9));
  const test::Folder folder;
  none.write("log", Archive(PETSC_COMM_WORLD));
  EXPECT_FALSE(none.exists());
  none.remove();  // nothing to remove
}

// An interval after the last entry, on all ranks together, even if the clocks of the ranks differ.
TEST(Checkpoint, IsDueAnIntervalAfterTheLastEntry) {
  const test::Folder folder;
  Checkpoint never = every(1e6, folder), always = every(0, folder);
  EXPECT_FALSE(never.due());
  EXPECT_TRUE(always.due());
  always.write("log", Archive(PETSC_COMM_WORLD));
  EXPECT_TRUE(always.due());
  Checkpoint sometimes = every(0.3, folder);
  std::this_thread::sleep_for(std::chrono::milliseconds(350));
  EXPECT_TRUE(sometimes.due());
  always.remove();
}

}  // namespace
}  // namespace squeal::checkpoint
