// SPDX-License-Identifier: BSD-2-Clause
// Reactions of ties, interfaces and periodic images, in balance with the loads.
#include <gtest/gtest.h>

#include <cmath>

#include "eigen/sweep/parameters.hpp"
#include "steady/steady/reactions.hpp"
#include "support/model/blocks_apart.hpp"
#include "support/model/model.hpp"
#include "support/steady/balance.hpp"

namespace squeal {
namespace {

using mesh::Point;
using steady::Wrench;
using test::Balance;
using test::opposite;

/// Two blocks that are meshed apart, the upper one (pad) at a distance, with loads on it.
std::string blocks(const std::string& distance) {
  test::BlockWriter writer;
  writer.add("disc", {test::hex8, {2, 3, 2}});
  const double gap = std::stod(distance);
  writer.add("pad", {test::hex8, {3, 2, 1}, {0.1, 0.1, 1 + gap}, {0.9, 0.9, 1.5 + gap}});
  return "-mesh_file " + test::writeFile("reactions_" + distance + ".msh", writer.text()) +
         test::material("disc", "2e11", "0.3", "8000") +
         test::material("pad", "1e11", "0.2", "5000") + "-constraint_disc_low_clamped xyz ";
}

TEST(Reactions, OfTies) {
  const std::string tie = "-tie_t_slave pad_low -tie_t_master disc_high -tie_t_adjust off ",
                    load = "-load_pad_high_force 100,200,-3000 ";
  for (const std::string distance : {"0", "1e-3"}) {
    test::setOptions(blocks(distance) + tie + load);
    const Balance found;
    const Wrench onPad = found.row("load", "force");
    found.expect("tie", "t", opposite(onPad));
    const Wrench offset = found.row("tie_offset", "t");
    //   gap × (force along the surface)
    if (distance == "0")
      found.expect("tie_offset", "t", {});
    else
      EXPECT_NEAR(offset.moment[1], -1e-3 * 100, 1e-4);
    // Supports of tied nodes act on the master.
    for (const std::string frame :
         {"", "-constraint_pad_x0_frame f -frame_f_x 3,4,0 -frame_f_xy 0,1,0 "}) {
      test::setOptions(blocks(distance) + tie + load + "-constraint_pad_x0_clamped yz " + frame);
      const Balance held;
      EXPECT_GT(mesh::length(held.row("support", "pad_x0").force), 1);
    }
  }
}

// Where masters are held, too, a support of a tied node holds it instead of the tie, or in turned
// axes is implied.
TEST(Reactions, OfSupportsThatOthersImply) {
  for (const std::string frame :
       {"", "-constraint_pad_low_frame f -frame_f_x 3,4,0 -frame_f_xy 0,1,0 "}) {
    test::setOptions(blocks("0") +
                     "-tie_t_slave pad_low -tie_t_master disc_high "
                     "-load_pad_high_force 100,200,-3000 -constraint_disc_high_clamped xyz "
                     "-constraint_pad_low_clamped yz " +
                     frame);
    const Balance found;
    EXPECT_NEAR(found.row("support", "pad_low").force[2], frame.empty() ? 3000 : 0, 1e-6);
    // The tie carries the components that it keeps.
    const Point tied = found.row("tie", "t").force;
    EXPECT_NEAR(tied[0], -100, 1e-6);
    EXPECT_NEAR(tied[1], frame.empty() ? 0 : -200, 1e-6);
    EXPECT_NEAR(tied[2], frame.empty() ? 0 : 3000, 1e-6);
  }
}

TEST(Reactions, OfStickingContact) {
  for (const std::string limit :
       {"", "-contact_c_friction 0.2 -contact_c_release on ",
        "-contact_c_friction 0.01 -contact_c_release on -ground_pad_low_stiffness 1e9,1e9,1e4 "}) {
    test::setOptions(blocks("0") +
                     "-contact_c_pad pad_low -contact_c_disc disc_high -contact_c_role sticking "
                     "-load_pad_high_pressure 1e5 -load_pad_high_force 3000,1000,0 " +
                     limit);
    const Balance found;
    const Wrench force = found.row("interface", "c");
    EXPECT_NEAR(force.force[2], 1e5 * 0.8 * 0.8, 10);
    if (limit.empty()) {
      EXPECT_NEAR(force.force[0], -3000, 1e-6);
    }
  }
}

TEST(Reactions, OfContactBetweenBodies) {
  const std::string slide =
      "-contact_c_pad pad_low -contact_c_disc disc_high -motion_disc_velocity 1,0,0 "
      "-ground_pad_high_stiffness 1e10,2e10,0 -load_pad_high_pressure 1e5 ";
  for (const std::string distance : {"0", "1e-3"}) {
    test::setOptions(blocks(distance) + slide + "-ground_pad_low_stiffness 1e9,1e9,1e4 ");
    const Balance found(sweep::Parameters{0.3});
    const Wrench offset = found.row("interface_offset", "c");
    // Friction acts at a distance if the surfaces lie apart.
    EXPECT_NEAR(offset.moment[1], std::stod(distance) * found.row("interface", "c").force[0], 1e-6);
    EXPECT_NEAR(found.row("interface", "c").force[2], 1e5 * 0.8 * 0.8, 10);
    EXPECT_NEAR(found.row("interface", "c").force[0], 0.3 * found.row("interface", "c").force[2],
                1e-6);
  }
}

TEST(Reactions, OfThePeriodicLayers) {
  for (const std::string name : {"layer", "two_layers"})
    for (const double friction : {0.0, 0.3}) {
      test::setCase(
          name, name == "layer" ? "-mesh_set nx=12,ny=4" : "-mesh_set nx=12,ny_disc=4,ny_pad=3");
      const Balance found(sweep::Parameters{friction});
      EXPECT_TRUE(found.has("periodic"));
      const Wrench interface = found.row("interface", name == "layer" ? "plate" : "interface");
      EXPECT_GT(std::abs(interface.force[1]), 1e-3);
      EXPECT_NEAR(std::abs(interface.force[0]), friction * std::abs(interface.force[1]), 1e-12);
    }
}

TEST(Reactions, OfMovingMatter) {
  test::setCase("two_layers_moving", "-mesh_set nx=12,ny_disc=4,ny_pad=3");
  const Balance found(sweep::Parameters{0.3});
  EXPECT_TRUE(found.has("periodic"));
}

}  // namespace
}  // namespace squeal
