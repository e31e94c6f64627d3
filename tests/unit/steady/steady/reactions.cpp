// SPDX-License-Identifier: BSD-2-Clause
// Reactions of supports, couplings, springs and interfaces: in closed form where the body is held
// statically determinate, and in balance with the loads everywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"
#include "steady/steady/reactions.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"
#include "support/steady/balance.hpp"

namespace squeal {
namespace {

using mesh::Point;
using steady::Wrench;
using test::Balance;
using test::forceAt;
using test::opposite;
using test::sum;

constexpr double mass = 8000 * 1 * 0.4 * 0.3;
const std::string clamp = "-constraint_clamped_clamped xyz ";
/// A reference node away from all groups.
const Point eccentric{1.3, 0.2, -0.4};
const std::string atEccentric = "-reference_r_position 1.3,0.2,-0.4 -coupling_c_reference r ",
                  force = "-load_r_force 300,-500,700 ", moment = "-load_r_moment 20,40,-90 ";

const Wrench applied = forceAt(eccentric, {300, -500, 700}, {20, 40, -90});

TEST(Reactions, OfARigidCoupling) {
  const Balance found(clamp + atEccentric + "-coupling_c_nodes tip " + force + moment);
  found.expect("support", "clamped", opposite(applied));
  found.expect("coupling", "c", opposite(applied));
  found.expect("reference", "r", applied);
  found.expect("load", "force", applied);
}

TEST(Reactions, OfADistributedCoupling) {
  const Balance found(clamp + atEccentric +
                      "-coupling_c_nodes tip,left -coupling_c_kind distributed "
                      "-coupling_c_weights 1,2.7 " +
                      force + moment);
  found.expect("support", "clamped", opposite(applied));
  found.expect("coupling", "c", opposite(applied));
  found.expect("reference", "r", applied);
}

TEST(Reactions, OfAChainOfReferenceNodes) {
  // r follows q, which follows the nodes of two groups.
  const Balance found(clamp +
                      "-reference_r_position 1.3,0.2,-0.4 -reference_q_position 2,1,1 "
                      "-coupling_c_reference q -coupling_c_nodes r -coupling_d_reference q "
                      "-coupling_d_nodes tip,top -coupling_d_kind distributed " +
                      force + moment);
  found.expect("support", "clamped", opposite(applied));
  found.expect("coupling", "c", applied);  // of r on q
  found.expect("coupling", "d", opposite(applied));
  found.expect("reference", "r", applied);
  found.expect("reference", "q", {});
}

TEST(Reactions, InTurnedAndCylindricalFrames) {
  const Point x{0.6, 0.8, 0}, y{-0.8, 0.6, 0}, z{0, 0, 1};
  const Point turned = mesh::plus(mesh::plus(mesh::scaled(x, 300), y, -500), z, 700);
  const Balance inTurned(clamp + atEccentric + "-coupling_c_nodes tip " + force +
                         "-load_r_frame f -frame_f_x 3,4,0 -frame_f_xy 0,1,0 ");
  inTurned.expect("support", "clamped", opposite(forceAt(eccentric, turned)));
  // The reference node lies at (1, 0.75) from the axis.
  const Point radial{0.8, 0.6, 0}, around{-0.6, 0.8, 0};
  const auto along = [&](double a, double b, double c) {
    return mesh::plus(mesh::plus(mesh::scaled(radial, a), around, b), z, c);
  };
  const Balance inCylinder(clamp + atEccentric + "-coupling_c_nodes tip " + force + moment +
                           "-load_r_frame f -frame_f_axis 0,0,1 -frame_f_origin 0.3,-0.55,7 "
                           "-constraint_clamped_frame f ");
  inCylinder.expect("support", "clamped",
                    opposite(forceAt(eccentric, along(300, -500, 700), along(20, 40, -90))));
}

TEST(Reactions, OfWeightAndSpin) {
  const Wrench weight = forceAt({0.5, 0, 0}, {0, 2 * mass, -9.81 * mass}),
               ofPoint = forceAt({1.3, 0.2, -0.3}, {0, 2 * 11.0, -9.81 * 11});
  const Balance byWeight(clamp + atEccentric +
                         "-coupling_c_nodes tip -mass_r_total 11 -mass_r_offset 0,0,0.1 "
                         "-load_gravity 0,2,-9.81");
  byWeight.expect("support", "clamped", opposite(sum(weight, ofPoint)));
  byWeight.expect("load", "gravity", sum(weight, ofPoint));
  byWeight.expect("reference", "r", ofPoint);
  // ∫ρ ω² (x − x0)⊥ and ∫ρ ω² x × (x − x0)⊥ of a box whose centre is at (0.5, 0, 0).
  const double scale = mass * 30 * 30;
  const Wrench spun{{0.5 * scale, scale, 0}, {0, 0, 0.5 * scale}};
  const Balance bySpin(clamp +
                       "-load_beam_spin 30 -load_beam_spin_origin 0,-1,0 "
                       "-load_beam_acceleration 0,0,3");
  bySpin.expect("load", "spin", spun);
  bySpin.expect("load", "gravity", forceAt({0.5, 0, 0}, {0, 0, 3 * mass}));
  bySpin.expect("support", "clamped", opposite(sum(spun, forceAt({0.5, 0, 0}, {0, 0, 3 * mass}))));
}

TEST(Reactions, OfPressureThatASweepScales) {
  // The pressure on the top, at y = 0.2, points to −y; the force keeps its value.
  const Balance found(
      clamp + "-load_top_pressure 1e4 -load_tip_force 0,0,50 -load_tip_hydraulic off", {0, 1, 1.5});
  EXPECT_TRUE(found.has("load"));
  found.expect("load", "force", forceAt({1, 0, 0}, {0, 0, 50}));
  const Wrench pressed = found.row("load", "pressure");
  found.expect("support", "clamped", opposite(sum(pressed, forceAt({1, 0, 0}, {0, 0, 50}))));
  EXPECT_NEAR(mesh::length(pressed.force), 1.5e4 * mesh::length(Point{0, 0, 0.4}), 1e-6);
}

TEST(Reactions, OfBushingsInSeries) {
  const std::string joined = atEccentric + "-coupling_c_nodes tip " + force + moment +
                             "-reference_s_position -0.2,0.1,0.3 -coupling_d_reference s "
                             "-coupling_d_nodes clamped ";
  const Balance toGround(joined +
                         "-bushing_b_from s -bushing_b_stiffness 1e8,2e8,3e8,4e7,5e7,6e7 "
                         "-bushing_b_frame f -frame_f_x 3,4,0 -frame_f_xy 0,1,0 ");
  toGround.expect("bushing", "b", opposite(applied));
  toGround.expect("coupling", "d", applied);
  EXPECT_FALSE(toGround.has("support"));
  const Balance between(joined +
                        "-reference_t_position -0.4,0,0 -constraint_t_clamped xyz "
                        "-constraint_t_clamped_rotation xyz -bushing_b_from t -bushing_b_to s "
                        "-bushing_b_stiffness 1e8,2e8,3e8,4e7,5e7,6e7 ");
  between.expect("bushing", "b", opposite(applied));
  between.expect("support", "t", opposite(applied));
  between.expect("reference", "t", {});
}

TEST(Reactions, OfSprings) {
  const Balance found(
      clamp + atEccentric + "-coupling_c_nodes tip " + force + moment +
      "-reference_t_position 1.3,0.2,-1.4 -constraint_t_clamped xyz "
      "-constraint_t_clamped_rotation xyz -spring_k_from t -spring_k_to r -spring_k_stiffness 1e9 "
      "-ground_tip_stiffness 1e8,2e8,3e8 ");
  const Wrench spring = found.row("spring", "k");
  EXPECT_GT(std::abs(spring.force[2]), 1);  // it acts along z at (1.3, 0.2)
  found.expect("spring", "k", forceAt(eccentric, {0, 0, spring.force[2]}));
  found.expect("support", "t", spring);
  found.expect("reference", "r", sum(applied, spring));
  found.expect("support", "clamped",
               opposite(sum(sum(applied, found.row("ground", "tip")), spring)));
}

// Springs along the radii of a cylinder about a line through (0.5, 0, −0.3): they exert no moment
// about it, and none of their forces is along it.
TEST(Reactions, OfGroundSpringsInAFrame) {
  const Balance found(atEccentric + "-coupling_c_nodes tip " + force + moment + clamp +
                      "-ground_top_stiffness 1e9,0,0 -ground_top_frame f -frame_f_axis 0,1,0 "
                      "-frame_f_origin 0.5,0,-0.3 ");
  const Wrench ground = found.row("ground", "top");
  const Point axis{0, 1, 0},
      about = mesh::minus(ground.moment, mesh::cross({0.5, 0, -0.3}, ground.force));
  EXPECT_GT(mesh::length(ground.force), 1);
  EXPECT_NEAR(mesh::dot(ground.force, axis), 0, 1e-9 * mesh::length(ground.force));
  EXPECT_NEAR(mesh::dot(about, axis), 0, 1e-9 * mesh::length(ground.force));
  found.expect("support", "clamped", opposite(sum(applied, ground)));
}

TEST(Reactions, OfSlantedSupports) {
  const std::string slanted =
      "-constraint_tip_clamped x -constraint_tip_frame f -frame_f_x 3,4,0 -frame_f_xy 0,1,0 ";
  const Balance found(clamp + slanted + "-load_top_pressure 1e6 -load_gravity 0,0,-9.81 ");
  const Wrench tip = found.row("support", "tip");
  EXPECT_GT(mesh::length(tip.force), 1e3);
  EXPECT_NEAR(mesh::dot(tip.force, {-0.8, 0.6, 0}), 0, 1e-9 * mesh::length(tip.force));
  EXPECT_NEAR(tip.force[2], 0, 1e-9 * mesh::length(tip.force));
  // Prescribed displacements give reactions without loads.
  const Balance moved(clamp + slanted + "-constraint_tip_displacement 1e-5,0,0 ");
  moved.expect("support", "tip", opposite(moved.row("support", "clamped")));
}

// Each of three groups holds a node in its own direction, and none is across another one.
TEST(Reactions, OfObliqueSupports) {
  const std::string groups =
      "-constraint_tip_clamped x -constraint_tip_frame e -frame_e_x 1,0.5,0 -frame_e_xy 0,1,0 "
      "-constraint_top_clamped x -constraint_top_frame f -frame_f_x 0,1,1 -frame_f_xy 1,1,0 "
      "-load_gravity 1e3,2e3,3e3 ";
  for (const std::string coupled : {"",
                                    "-reference_s_position 0.9,0.1,0 -coupling_d_reference s "
                                    "-coupling_d_nodes tip "}) {
    const Balance found(clamp + groups + coupled);
    const Wrench tip = found.row("support", "tip"), top = found.row("support", "top");
    for (const auto& [force, direction] :
         {std::pair{tip.force, Point{1, 0.5, 0}}, {top.force, Point{0, 1, 1}}}) {
      EXPECT_GT(mesh::length(force), 1);
      EXPECT_LT(mesh::length(mesh::cross(force, mesh::unit(direction))),
                1e-9 * mesh::length(force));
    }
  }
}

/// The clamped end follows a reference node.
const std::string end = atEccentric + "-coupling_c_nodes tip " + force + moment +
                        "-reference_s_position -0.1,0.3,0.2 -coupling_d_reference s "
                        "-coupling_d_nodes clamped ";

TEST(Reactions, OfEquations) {
  const Point s{-0.1, 0.3, 0.2};
  const Balance found(end +
                      "-constraint_s_clamped_rotation xyz -equation_a 's:x + 2*s:y = 0' "
                      "-equation_b 's:x - s:y = 0' -equation_z 's:z + 1e-3*s:rx = 0' ");
  const Point f = applied.force, m = mesh::minus(applied.moment, mesh::cross(s, f));
  // λ_a (1, 2) + λ_b (1, −1) = −(f_x, f_y)
  const double a = -(f[0] + f[1]) / 3, b = -f[0] - a;
  found.expect("equation", "a", forceAt(s, {a, 2 * a, 0}));
  found.expect("equation", "b", forceAt(s, {b, -b, 0}));
  found.expect("equation", "z", forceAt(s, {0, 0, -f[2]}, {-1e-3 * f[2], 0, 0}));
  // The equation z loads the held rotation, too.
  found.expect("support", "s", {{}, {-m[0] + 1e-3 * f[2], -m[1], -m[2]}});
  found.expect("reference", "s", opposite(applied));
}

TEST(Reactions, OfAnEquationBetweenPoints) {
  // r and t, which lie apart, move by the same amount along y: the equation holds r by t.
  const Balance found(clamp + atEccentric + "-coupling_c_nodes tip " + force + moment +
                      "-reference_t_position 1.3,0.9,-0.4 -constraint_t_clamped xz "
                      "-constraint_t_clamped_rotation xyz -equation_a 'r:y - t:y = 0' "
                      "-bushing_b_from t -bushing_b_stiffness 0,1e8,0,0,0,0 ");
  const Wrench bushing = found.row("bushing", "b");
  EXPECT_GT(std::abs(bushing.force[1]), 1);
  found.expect("equation", "a", {});  // a pair of forces on one line
  found.expect("support", "t", {});
  found.expect("support", "clamped", opposite(sum(applied, bushing)));
}

TEST(Reactions, OfSupportsOnCoupledNodes) {
  const Balance found(end + clamp);
  found.expect("support", "clamped", opposite(applied));
  found.expect("reference", "s", {});
  // In a turned frame one direction of the nodes, and the rest of the reference node.
  const Balance turned(end +
                       "-constraint_clamped_clamped x -constraint_clamped_frame f -frame_f_x 3,4,0 "
                       "-frame_f_xy 0,1,0 -constraint_s_clamped yz -constraint_s_frame f "
                       "-constraint_s_clamped_rotation xyz ");
  const Wrench nodes = turned.row("support", "clamped");
  const double along = mesh::dot(applied.force, {0.6, 0.8, 0});
  const Point expected = mesh::scaled(Point{0.6, 0.8, 0}, -along);
  EXPECT_LT(mesh::length(mesh::minus(nodes.force, expected)), 1e-8 * std::abs(along));
  turned.expect("support", "s", opposite(sum(applied, nodes)));
}

// In the plane a reference node has one rotation.
TEST(Reactions, InThePlane) {
  test::setOptions(
      "-mesh_file meshes/layer.geo -mesh_set nx=12,ny=4 " +
      test::material("layer", "1", "0.3", "1") +
      "-contact_plate_pad top -contact_plate_obstacle_velocity 1,0,0 "
      "-contact_plate_obstacle_displacement 0,-0.01,0 "
      "-reference_r_position 0.5,-1.5 -coupling_c_reference r -coupling_c_nodes bottom "
      "-constraint_r_clamped xy -constraint_r_clamped_rotation z "
      "-reference_s_position 5,1 -coupling_d_reference s -coupling_d_nodes left "
      "-coupling_d_kind distributed -load_s_force 1e-3,2e-3 -load_s_moment 0,0,3e-3 "
      "-bushing_b_from s -bushing_b_stiffness 0.01,0.02,0.03 ");
  const Balance found(sweep::Parameters{0.3});
  const Wrench loaded = forceAt({5, 1, 0}, {1e-3, 2e-3, 0}, {0, 0, 3e-3});
  found.expect("load", "force", loaded);
  found.expect("coupling", "d", opposite(sum(loaded, found.row("bushing", "b"))));
  EXPECT_GT(std::abs(found.row("bushing", "b").moment[2]), 1e-6);
  found.expect("coupling", "c", opposite(found.row("support", "r")));
}

}  // namespace
}  // namespace squeal
