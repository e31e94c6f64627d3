// SPDX-License-Identifier: BSD-2-Clause
// The number of ranks does not show in the results. critical.cpp compares the tracked eigenvalues.
#include "support/harness/same_on_ranks.hpp"

namespace squeal::test {
namespace {

// Modes of the periodic layer come in pairs. 100 would cut one, and which of its combinations the
// basis keeps is left to rounding: the topmost eigenvalues would differ. 101 ends with a whole
// pair.
TEST(Ranks, Layer) {
  expectSameOnAllRanks("layer",
                       "-options_file options/layer.yaml -modes_count 101 -flutter_track off", 120);
}

TEST(Ranks, CoarseDiscBrake) {
  expectSameOnAllRanks(
      "disc_brake_coarse",
      "-options_file options/disc_brake.yaml -modes_count 60 -flutter_friction 0,0.2,0.4,0.6"
      " -flutter_track off"
      " -mesh_set "
      "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,n_hat=2,n_h_ring=2",
      120);
}

}  // namespace
}  // namespace squeal::test
