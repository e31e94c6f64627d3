// SPDX-License-Identifier: BSD-2-Clause
// A coarse disc brake whose disc is turned under the pad by a third of a cell, and whose pad has
// three cells on two of the disc: unstable modes are those of meshes that match.
#include <gtest/gtest.h>

#include "support/run/disc_brake_modes.hpp"

namespace squeal::test {
namespace {

const std::string coarse =
    "n_free_theta=20,n_mount=2,n_plate=2,n_wall=1,n_inside=1,n_h_plate=1,n_hat=2,n_h_ring=2,"
    "n_h_lining=1,";
const std::string band = " -modes_count 60 -flutter_band 9500";

// The disc is a body of revolution, so turning it changes only its mesh.
TEST(NonMatchingBrake, DiscTurned) {
  const auto matching = unstable(coarse + "n_pad_theta=12,n_pad_r=5", band);
  for (const char* slave : {"pad", "disc"})
    expectSameModes(unstable(coarse + "n_pad_theta=12,n_pad_r=5,apart=1,n_disc_r=5,disc_turn=1.25",
                             band + " -contact_pad_slave " + slave),
                    matching);
}

// Against matching meshes that are fine under the whole pad. These and coarse ones tell how much
// the cells under the pad matter.
TEST(NonMatchingBrake, ThreeCellsOnTwo) {
  const auto matching = unstable(coarse + "n_pad_theta=18,n_pad_r=8", band);
  const auto before = unstable(coarse + "n_pad_theta=12,n_pad_r=5", band);
  expectSameModes(unstable(coarse + "n_pad_theta=18,n_pad_r=8,apart=1,n_disc_theta=12,n_disc_r=5,"
                                    "disc_turn=1.25",
                           band),
                  matching, before);
}

}  // namespace
}  // namespace squeal::test
