// SPDX-License-Identifier: BSD-2-Clause
// Contact that does not separate, -contact_<interface>_separation off: pulled and pressed layers
// have the same waves, and a block on a soft layer those of a beam on springs. With separation, the
// block lifts off its layer over a part of the face.
#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"
#include "support/steady/uniform_layers.hpp"

namespace squeal::test {
namespace {

const std::string
    small =
        "-mesh_set nx=6,ny_disc=3,ny_pad=2 -flutter_method direct -flutter_direct_count 20 "
        "-flutter_track off ",
    kept = "-contact_interface_separation off ",
    pulled = "-constraint_pad_top_displacement 0,0.01,0 ";

std::vector<Complex> last(const analysis::Analysis& analysis) {
  return eigenvaluesOf(analysis.flutter.segments.back().points.back());
}

// Pressed, nothing separates anyway. Pulled, the pressure is the negative of the pressed one, and
// without friction the waves do not know it.
TEST(NoSeparation, LeavesPressedContactAndTurnsTheSignOfPulledContact) {
  const auto pressed = runCase("two_layers", small + "-flutter_friction 0.3"),
             same = runCase("two_layers", small + kept + "-flutter_friction 0.3"),
             free = runCase("two_layers", small + "-flutter_friction 0"),
             turned = runCase("two_layers", small + kept + pulled + "-flutter_friction 0");
  EXPECT_LT(worst(errors(last(pressed), last(same)).relative), 1e-10);
  EXPECT_LT(worst(errors(last(free), last(turned)).relative), 1e-10);
  const auto &push = free.steady.solutions[0], &pull = turned.steady.solutions[0];
  ASSERT_TRUE(push.converged && pull.converged) << pull.reason;
  EXPECT_EQ(pull.openNodes, 0);
  for (std::size_t i = 0; i < push.contact.size(); ++i)
    EXPECT_NEAR(pull.contact[i].pressure / push.contact[i].pressure, -1, 1e-10);
  EXPECT_LT(pull.imbalance, 1e-10);
  // -steady_full on solves with all unknowns instead of those of the contact.
  const auto all =
      runCase("two_layers", small + kept + pulled + "-flutter_friction 0 -steady_full on");
  ASSERT_TRUE(all.steady.solutions[0].converged);
  EXPECT_NEAR(all.steady.solutions[0].smallestPressure / pull.smallestPressure, 1, 1e-10);
}

// Without this option nothing presses the layers together: they separate everywhere.
TEST(NoSeparation, IsNotTheDefault) {
  const auto open = runCase("two_layers", small + pulled + "-flutter_friction 0");
  EXPECT_GT(open.steady.solutions[0].openNodes, 0);
}

// Coulomb's law has no friction under tension: the point is refused, and others are solved.
TEST(NoSeparation, RefusesFrictionUnderTension) {
  const auto analysis = runCase("two_layers", small + kept + pulled + "-flutter_friction 0,0.3");
  ASSERT_EQ(analysis.steady.solutions.size(), 2U);
  EXPECT_TRUE(analysis.steady.solutions[0].converged);
  EXPECT_FALSE(analysis.steady.solutions[1].converged);
  const std::string& reason = analysis.steady.solutions[1].reason;
  EXPECT_NE(reason.find("friction needs pressure"), std::string::npos) << reason;
  EXPECT_NE(reason.find("-contact_interface_separation"), std::string::npos) << reason;
}

// A sticking interface that may slide is one with friction, too: released under tension its nodes
// would be pushed in the direction of motion.
TEST(NoSeparation, RefusesReleasedNodesUnderTension) {
  const std::string sticking =
      small + kept + "-flutter_friction 0 -contact_interface_role sticking " +
      "-contact_interface_friction 0.1 -constraint_pad_top_displacement 0.01,";
  for (const std::string full : {"off", "on"}) {
    const auto refused = runCase(
        "two_layers", sticking + "0.01,0 -contact_interface_release on -steady_full " + full);
    EXPECT_FALSE(refused.converged());
    const std::string& reason = refused.steady.solutions.at(0).reason;
    for (const std::string part : {"interface 'interface'", "nodes with friction are under tension",
                                   "friction needs pressure", "-contact_interface_separation off"})
      EXPECT_NE(reason.find(part), std::string::npos) << reason;
    // Under pressure the same nodes slide: the shear stress is about that of the pressure.
    const auto pressed = runCase(
        "two_layers", sticking + "-0.01,0 -contact_interface_release on -steady_full " + full);
    ASSERT_TRUE(pressed.converged()) << pressed.steady.solutions.at(0).reason;
    EXPECT_EQ(pressed.steady.solutions.at(0).resultants.at(0).released,
              pressed.model.contact.interfaces.totalNodes);
  }
  // Without a release the interface is a bond: its nodes are beyond any coefficient of friction,
  // and none is the least sufficient one.
  const auto bonded = runCase("two_layers", sticking + "0.01,0");
  ASSERT_TRUE(bonded.converged()) << bonded.steady.solutions.at(0).reason;
  const auto& resultant = bonded.steady.solutions.at(0).resultants.at(0);
  EXPECT_EQ(resultant.overLimit, bonded.model.contact.interfaces.totalNodes);
  EXPECT_EQ(resultant.pulled, resultant.overLimit);
  EXPECT_EQ(resultant.leastFriction, 0);
}

/// A stiff block, 3 × 1 with the mass 3 kg, on a soft layer of 1 N/m3 on its upper face. A force of
/// 0.1 N at the distance `arm` from the middle presses it up against a rigid obstacle; the
/// reference node of its lower face has no motion along x.
std::string block(double arm, const std::string& contact, int cells) {
  return formatted(
      "-mesh_file meshes/layer.geo -mesh_set nx=%d,ny=2 -material_layer_young 1e7 "
      "-material_layer_poisson 0 -material_layer_density 1 -contact_plate_pad top "
      "-contact_plate_obstacle_velocity 1,0,0 -contact_plate_role frictionless "
      "-contact_plate_stiffness 1 -reference_r_position %.15g,-1 -coupling_c_reference r "
      "-coupling_c_nodes bottom -constraint_r_clamped x -load_r_force 0,0.1 "
      "-flutter_friction 0 -flutter_method direct -flutter_direct_count 2 %s",
      cells, 1.5 + arm, contact.c_str());
}

/// The two frequencies, squared, of the rigid block on springs of 1 N/m3 between these distances
/// from its middle: heave v and pitch θ about the reference node at `arm`, 1 m below.
std::array<double, 2> rigidBlock(double arm, double from, double to) {
  const double m = 3, inertia = m * (3 * 3 + 1) / 12;  // about the centre of the block
  const auto moment = [&](int power) {
    return (std::pow(to - arm, power + 1) - std::pow(from - arm, power + 1)) / (power + 1);
  };
  // The centre is at (−arm, ½) from the reference node, which does not move along x.
  const double k11 = moment(0), k12 = moment(1), k22 = moment(2), m11 = m, m12 = -m * arm,
               m22 = inertia + m * (arm * arm + 0.25);
  //   det(K − λ M) = 0
  const double a = m11 * m22 - m12 * m12, b = -(k11 * m22 + k22 * m11 - 2 * k12 * m12),
               c = k11 * k22 - k12 * k12, root = std::sqrt(b * b - 4 * a * c);
  return {(-b - root) / (2 * a), (-b + root) / (2 * a)};
}

std::array<double, 2> squares(const analysis::Analysis& analysis) {
  const auto found = last(analysis);
  EXPECT_GE(found.size(), 2U);
  return {std::norm(found.at(0)), std::norm(found.at(1))};
}

// In the middle third the layer is pressed everywhere: p = F/3 ± …, and the whole of it is a
// spring. The modulus of the block, 1e7 times the stiffness of its layer, is the error.
TEST(SoftLayer, CarriesABlock) {
  // A coupling may hold the nodes of the face below the layer: then the face is rigid as well.
  for (const std::string options : {"-contact_plate_separation on", "-contact_plate_separation off",
                                    "-coupling_c_nodes bottom,top"}) {
    const auto analysis = runOptions(block(0.3, options, 6));
    const auto& solution = analysis.steady.solutions.at(0);
    ASSERT_TRUE(solution.converged) << solution.reason;
    EXPECT_EQ(solution.openNodes, 0);
    const auto found = squares(analysis), wanted = rigidBlock(0.3, -1.5, 1.5);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(found[i] / wanted[i], 1, 2e-6);
  }
}

// A force outside of the middle third lifts the block off over a part: the pressure is a triangle
// over 3 (b/2 − arm) = 2 m with the force as its area. Its end is a node, so that cells show the
// pressure exactly.
TEST(SoftLayer, LetsABlockLiftOff) {
  const double arm = 1.5 - 2.0 / 3;
  std::vector<std::array<double, 2>> found;
  for (const int cells : {24, 48}) {
    const auto analysis = runOptions(block(arm, "", cells));
    const auto& solution = analysis.steady.solutions.at(0);
    ASSERT_TRUE(solution.converged) << solution.reason;
    EXPECT_EQ(solution.openNodes, cells / 3);  // over 1 of 3 m, the end of contact is closed
    double largestPressure = 0, force = 0, largestGap = 0;
    for (const auto& state : solution.contact) {
      largestPressure = worse(largestPressure, state.pressure);
      largestGap = worse(largestGap, state.gap), force += state.normalForce;
    }
    EXPECT_NEAR(total(force), 0.1, 1e-8);
    // Mean of the pressure around the last node, half a cell wide: p_max (1 − h/6) with p_max =
    // 0.1.
    EXPECT_NEAR(largest(largestPressure), 0.1 * (1 - 3.0 / cells / 6), 1e-7);
    EXPECT_NEAR(largest(largestGap), 0.05, 1e-7);  // half as far from the end as p_max/k
    found.push_back(squares(analysis));
  }
  // In a cell beside the end of contact the layer has to be zero at that node: an error of first
  // order, which extrapolation removes.
  const auto wanted = rigidBlock(arm, -0.5, 1.5);
  for (std::size_t i = 0; i < 2; ++i) {
    const double coarse = found[0][i] / wanted[i] - 1, fine = found[1][i] / wanted[i] - 1;
    print("mode %zu: errors %.2e, %.2e\n", i + 1, coarse, fine);
    EXPECT_NEAR(coarse / fine, 2, 0.1);
    EXPECT_NEAR(2 * fine - coarse, 0, 2e-3);
  }
}

// The same block held by its layer also where it is pulled: all of the layer is a spring.
TEST(SoftLayer, HoldsABlockThatDoesNotSeparate) {
  const double arm = 1.5 - 2.0 / 3;
  const auto analysis = runOptions(block(arm, "-contact_plate_separation off", 6));
  const auto& solution = analysis.steady.solutions.at(0);
  ASSERT_TRUE(solution.converged) << solution.reason;
  EXPECT_EQ(solution.openNodes, 0);
  EXPECT_LT(solution.smallestPressure, 0);
  const auto found = squares(analysis), wanted = rigidBlock(arm, -1.5, 1.5);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(found[i] / wanted[i], 1, 2e-6);
}

}  // namespace
}  // namespace squeal::test
