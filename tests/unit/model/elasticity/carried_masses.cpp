// SPDX-License-Identifier: BSD-2-Clause
// Point masses that a rotating body carries: gyroscopic terms against those of a body with cells,
// centrifugal forces in closed form, and masses that are not steady.
#include "model/elasticity/carried_masses.hpp"

#include <gtest/gtest.h>

#include "model/elasticity/attached_parts.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using mesh::cross;
using mesh::Point;

constexpr double speed = 7;

/// A ring about z with the radii 0.8 and 1.2 and the width 0.5, at the speed 7 rad/s, and the
/// reference node `hub`, which a rigid coupling connects with its inner face.
std::string ring(const std::string& options, const std::string& place = "0,0,0.3") {
  return "-mesh_file meshes/ring.geo -mesh_set R=1,thickness=0.4,width=0.5,n_theta=16,order=2 " +
         test::material("ring", "1e9", "0.3", "2500") +
         "-motion_ring_speed 7 -motion_ring_axis 0,0,1 -motion_ring_origin 0,0,0 "
         "-reference_hub_position " +
         place + " -coupling_hub_reference hub -coupling_hub_nodes inner " + options;
}

/// Collective. Returns vᵀ G u.
double form(Vec v, Mat matrix, Vec u) {
  OwnedVec product;
  PetscScalar value = 0;
  check(VecDuplicate(u, product.out()));
  check(MatMult(matrix, u, product));
  check(VecDot(v, product, &value));
  return value;
}

const std::string inertia = "-mass_hub_total 5 -mass_hub_inertia 0.2,0.2,0.35,0,0,0 ";

// A rigid tilt costs ω J_p (θ × k)·θ' by G, for a point mass and for the ring, whose polar moment
// J_p is that of its own mass matrix.
TEST(CarriedMasses, GyroscopicMatrixIsThatOfASolid) {
  const std::string on = "-motion_convective on ";
  const auto [mesh, bodies] = test::buildBodies(ring(on));
  const auto with = test::buildBodies(ring(on + inertia));
  const Point a{0.3, -0.8, 0.1}, b{-0.5, 0.2, 0.4}, k{0, 0, 1};
  const OwnedVec u = test::rigidMotion(mesh, {}, a), v = test::rigidMotion(mesh, {}, b),
                 turn = test::rigidMotion(mesh, {}, k);
  const double unit = speed * mesh::dot(b, cross(a, k)), ofRing = form(v, bodies.gyroscopic, u);
  // The mass matrix is exact on the cells; the tables are rounded.
  EXPECT_NEAR(ofRing, unit * form(turn, bodies.mass, turn), 1e-11 * std::abs(ofRing));
  EXPECT_NEAR(form(v, with.bodies.gyroscopic, u) - ofRing, unit * 0.35, 1e-11 * std::abs(ofRing));
  EXPECT_NEAR(form(u, with.bodies.gyroscopic, v), -form(v, with.bodies.gyroscopic, u),
              1e-12 * std::abs(ofRing));
}

/// The centrifugal force and moment on a reference node.
struct OnNode {
  Point force{}, moment{};
};

/// Collective. Returns them for a model with these options.
OnNode centrifugalOn(const std::string& name, const std::string& options) {
  const auto [mesh, bodies] = test::buildBodies(options);
  const auto& node = *mesh.reference(name);
  OnNode found;
  const ReadArray values(bodies.centrifugal);
  for (auto [global, at] :
       {std::pair{node.displacement, &found.force}, {node.rotation, &found.moment}})
    if (const PetscInt own = mesh.ownedNode(global); own >= 0)
      for (int d = 0; d < mesh.dimension; ++d) (*at)[d] = values[mesh.dimension * own + d];
  for (Point* sum : {&found.force, &found.moment}) mpi::reduce<double>(mesh.comm, *sum, MPI_SUM);
  return found;
}

void expectEqual(const Point& found, const Point& expected) {
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(found[d], expected[d], 1e-12 * 1000) << d;
}

TEST(CarriedMasses, CentrifugalForces) {
  const Point place{0.4, 0.1, 0.3}, arm{0.2, -0.3, 0.05}, centre = mesh::plus(place, arm);
  const auto found =
      centrifugalOn("hub", ring("-mass_hub_total 5 -mass_hub_inertia 0.2,0.25,0.35,0.01,0.02,-0.03 "
                                "-mass_hub_offset 0.2,-0.3,0.05 ",
                                "0.4,0.1,0.3"));
  const Point force{5 * speed * speed * centre[0], 5 * speed * speed * centre[1], 0};
  expectEqual(found.force, force);
  //   J k = (0.02, −0.03, 0.35)
  const Point turning = mesh::scaled(cross({0, 0, 1}, {0.02, -0.03, 0.35}), -speed * speed);
  expectEqual(found.moment, mesh::plus(cross(arm, force), turning));
  // At the end of a chain of couplings; without the option; and not on a bushing.
  expectEqual(centrifugalOn("arm", ring("-reference_arm_position 0.5,0,0 -coupling_arm_reference "
                                        "hub -coupling_arm_nodes arm -mass_arm_total 2 "))
                  .force,
              {2 * speed * speed * 0.5, 0, 0});
  const std::string at = "0.5,0,0", mass = "-mass_hub_total 2 ";
  expectEqual(centrifugalOn("hub", ring(mass, at)).force, {2 * speed * speed * 0.5, 0, 0});
  expectEqual(centrifugalOn("hub", ring(mass + "-load_centrifugal off ", at)).force, {});
  expectEqual(
      centrifugalOn("hub", "-mesh_file meshes/ring.geo " +
                               test::material("ring", "1e9", "0.3", "2500") +
                               "-motion_ring_speed 7 -reference_hub_position 0.5,0,0 "
                               "-reference_pin_position 0,0,0 -coupling_pin_reference pin "
                               "-coupling_pin_nodes inner -bushing_b_from pin -bushing_b_to hub "
                               "-bushing_b_stiffness 1,1,1,1,1,1 " +
                               mass)
          .force,
      {});
}

TEST(CarriedMasses, UnsteadyOnesAreNamed) {
  const auto message = [](const std::string& options) {
    return test::errorOf([&] { test::buildBodies(options + "-motion_convective on "); });
  };
  const std::string head = "option -mass_hub_total: the mass moves with body 'ring', ",
                    end =
                        ": it is not steady in the axes of the vehicle; use -motion_convective off "
                        "(approximation A)";
  EXPECT_EQ(message(ring(inertia)), "");
  EXPECT_EQ(message(ring("-mass_hub_total 5 ", "0.0005,0,0")), "");  // within a thousandth
  EXPECT_EQ(message(ring("-mass_hub_total 5 ", "0.05,0,0")),
            head + "and its centre is 0.05 m off the axis of the rotation" + end);
  EXPECT_EQ(message(ring("-mass_hub_total 5 -mass_hub_inertia 0.2,0.25,0.35,0,0,0 ")),
            head + "and its inertia is not that of a figure of revolution about the axis" + end);
  EXPECT_EQ(message(ring("-mass_outer_total 5 ")).substr(0, 62),
            "option -mass_outer_total: the mass moves with body 'ring', and");
}

// A reference node that a second coupling connects with a body at rest. One warning, also if the
// contributions of each mass are derived.
TEST(CarriedMasses, MixedMotionsAreReported) {
  const std::string warning = test::warningsOf([] {
    const auto built = test::buildBodies(
        "-mesh_file meshes/steel_brake.geo " + test::material("disc", "1e11", "0.3", "7000") +
        test::material("upper", "1e9", "0.3", "2500") +
        test::material("lower", "1e9", "0.3", "2500") +
        "-motion_disc_speed 5 -reference_hub_position 0.1,0,0 -coupling_hub_reference hub "
        "-coupling_hub_nodes bore,upper_back -mass_hub_total 2 ");
    EXPECT_EQ(elasticity::attachedParts(built.mesh, built.bodies).size(), 1u);
  });
  EXPECT_TRUE(test::contains(warning,
                             "option -mass_hub_total: the mass belongs to bodies that move "
                             "differently ('disc', 'upper'), so it has no centrifugal forces and "
                             "no gyroscopic terms"))
      << warning;
  EXPECT_EQ(warning.find("-mass_hub_total"), warning.rfind("-mass_hub_total")) << warning;
}

}  // namespace
}  // namespace squeal
