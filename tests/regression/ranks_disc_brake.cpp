// SPDX-License-Identifier: BSD-2-Clause
// The disc brake at its full size on 1, 2 and 3 ranks: minutes, so not part of the usual run.
#include "support/harness/same_on_ranks.hpp"

namespace squeal::test {
namespace {

TEST(Ranks, DiscBrake) {
  expectSameOnAllRanks(
      "disc_brake",
      "-options_file options/disc_brake.yaml -modes_count 200 -flutter_friction 0,0.2,0.4,0.6",
      600);
}

}  // namespace
}  // namespace squeal::test
