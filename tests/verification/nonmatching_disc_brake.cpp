// SPDX-License-Identifier: BSD-2-Clause
// The disc brake at its full size with meshes that do not match: unstable modes are those of
// matching meshes, the more so the finer the meshes are. Minutes, so not part of the usual run.
#include <gtest/gtest.h>

#include "support/run/disc_brake_modes.hpp"

namespace squeal::test {
namespace {

const std::string under =
    "n_pad_theta=36,n_pad_r=15";  // cells under the pad; the default is 24, 10

TEST(NonMatchingDiscBrake, DiscTurnedAndTwoCellsOnThree) {
  const auto matching = unstable("order=1", ""), fine = unstable(under, "");
  const Distance turned = expectSameModes(unstable("apart=1,disc_turn=0.625", ""), matching);
  // Either side is finer, and the cells under the pad matter as much as the other matching mesh
  // says.
  expectSameModes(unstable("apart=1,disc_turn=0.625,n_disc_theta=36,n_disc_r=15", ""), matching,
                  fine);
  expectSameModes(unstable(under + ",apart=1,disc_turn=0.625,n_disc_theta=24,n_disc_r=10", ""),
                  fine, matching);
  const Distance turnedFine = expectSameModes(
      unstable(under + ",apart=1,disc_turn=0.41666666666666667,n_disc_theta=36,n_disc_r=15", ""),
      fine);
  EXPECT_LT(turnedFine.frequency, turned.frequency);
  EXPECT_LT(turnedFine.growth, turned.growth);
}

}  // namespace
}  // namespace squeal::test
