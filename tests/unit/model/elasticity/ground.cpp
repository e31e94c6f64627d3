// SPDX-License-Identifier: BSD-2-Clause
// Springs and dashpots to the ground in the axes of a frame.
#include <gtest/gtest.h>

#include <cmath>

#include "support/algebra/dense.hpp"
#include "support/algebra/sparse.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Point;
using test::contains;

double difference(Mat one, Mat other) {
  const auto a = test::denseCopy(one), b = test::denseCopy(other);
  return test::largestDifference(a, b) / test::largestEntry(a);
}

// Ranks add their contributions in any order, so the last digit may differ on two of them.
constexpr double rounding = 1e-15;

/// The box whose tip is on ground springs.
std::string grounded(const std::string& springs) {
  return "-mesh_file meshes/beam.geo -mesh_set nx=2,ny=2,nz=2,Lx=1,Ly=1,Lz=1 " +
         test::material("beam", "2", "0.3", "1") + springs;
}

// Σ over the nodes of Σ_k s_k (a_k·u)² / 9, with the axes a_k of the frame at each node.
TEST(Ground, SpringsAndDashpotsInTheAxesOfAFrame) {
  const auto displacement = [](const Point& x) {
    return Point{0.3 + x[1], 0.2 - x[2] * x[0], 0.5 * x[1] - 0.4};
  };
  for (const bool cylindrical : {false, true}) {
    const auto [mesh, bodies] = test::buildBodies(
        grounded("-ground_tip_stiffness 5,7,0 -ground_tip_damping 0.3,0,0.2 -ground_tip_frame f ") +
        (cylindrical ? "-frame_f_axis 1,0,1 -frame_f_origin 0,0.1,-2"
                     : "-frame_f_x 1,2,0.5 -frame_f_xy 0,1,1"));
    const auto u = test::nodalField(mesh, displacement);
    double springs = 0, dashpots = 0;
    for (const PetscInt node : mesh.nodeGroups.at("tip")) {
      const Point& x = mesh.coordinates[node];
      Point one = mesh::unit({1, 2, 0.5}), three = mesh::unit(mesh::cross({1, 2, 0.5}, {0, 1, 1}));
      if (cylindrical) {
        three = mesh::unit({1, 0, 1});
        one = mesh::unit(mesh::tangential(mesh::minus(x, {0, 0.1, -2}), three));
      }
      const Point two = mesh::cross(three, one), value = displacement(x);
      const auto square = [&](const Point& a) { return std::pow(mesh::dot(a, value), 2) / 9; };
      springs += 5 * square(one) + 7 * square(two);
      dashpots += 0.3 * square(one) + 0.2 * square(three);
    }
    springs = test::total(springs), dashpots = test::total(dashpots);
    EXPECT_NEAR(test::form(u, bodies.springs, u), springs, 1e-14 * springs);
    EXPECT_NEAR(test::form(u, bodies.damping, u), dashpots, 1e-14 * dashpots);
    const auto free = test::buildBodies(grounded(""));
    const auto v = test::nodalField(free.mesh, displacement);
    EXPECT_NEAR(test::form(u, bodies.stiffness, u) - test::form(v, free.bodies.stiffness, v),
                springs, 1e-13 * test::form(u, bodies.stiffness, u));
  }
}

// A frame along the global axes changes nothing, not even rounding.
TEST(Ground, GlobalFrame) {
  const std::string springs = "-ground_tip_stiffness 5,7,3 -ground_tip_damping 0.3,0.1,0.2 ";
  const auto one = test::buildBodies(grounded(springs)),
             two = test::buildBodies(grounded(springs) +
                                     "-ground_tip_frame f -frame_f_x 2,0,0 -frame_f_xy 1,3,0");
  EXPECT_EQ(difference(one.bodies.springs, two.bodies.springs), 0);
  EXPECT_EQ(difference(one.bodies.damping, two.bodies.damping), 0);
  EXPECT_LE(difference(one.bodies.stiffness, two.bodies.stiffness), rounding);
}

// Springs normal to a slanted plane hold a translation and two rotations; the rest is loose.
TEST(Ground, SlantedSpringsSupportInTheirDirection) {
  const auto message = [](const std::string& more) {
    test::setOptions(grounded("-ground_tip_stiffness 5,0,0 -ground_tip_frame f -frame_f_x 1,2,0.5 "
                              "-frame_f_xy 0,1,1 ") +
                     more);
    return test::errorOf([] { test::buildModel(); });
  };
  EXPECT_TRUE(contains(message(""), "can move rigidly")) << message("");
  EXPECT_TRUE(contains(message(""), "-ground_<group>_stiffness or -bushing_<name>_stiffness"));
  EXPECT_EQ(message("-ground_right_stiffness 1,1,1"), "");
}

TEST(Ground, RefusesFramesThatDoNotSuit) {
  const auto expect = [](const std::string& options, const std::string& part) {
    const auto message = test::errorOf([&] { test::buildBodies(grounded(options)); });
    EXPECT_TRUE(contains(message, part)) << options << ": " << message;
  };
  expect("-ground_tip_frame f -frame_f_x 1,0,0", "-ground_tip_stiffness");
  expect("-ground_tip_stiffness 1,1,1 -ground_tip_frame f",
         "option -ground_tip_frame f: no frame has this name");
  expect("-ground_tip_stiffness 1,1,1 -ground_tip_frame f -frame_f_axis 1,0,0",
         "option -ground_tip_frame f: the point (1, ");
}

}  // namespace
}  // namespace squeal
