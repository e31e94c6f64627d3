// SPDX-License-Identifier: BSD-2-Clause
// A pad face that is split into two groups, each with its own interface on one disc: the same
// contact as with one group.
#include <gtest/gtest.h>

#include <cmath>

#include "steady/steady/steady.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

/// A pad of two blocks side by side, 2 × 1 × 0.5, on a larger disc that is meshed apart or, with
/// `shared`, on one that shares its nodes.
std::string geometry(bool shared) {
  const std::string disc = shared ? R"(
h[] = Extrude{0, 0, -0.5}{ Surface{d[1]}; Layers{2}; Recombine; };
k[] = Extrude{0, 0, -0.5}{ Surface{e[1]}; Layers{2}; Recombine; };
Physical Surface("disc_face") = {d[1], e[1]};
Physical Surface("disc_low") = {h[0], k[0]};
Physical Volume("disc") = {h[1], k[1]};
)"
                                  : R"(
Point(1) = {-0.1, -0.1, 0}; Point(2) = {-0.1, 1.1, 0}; Line(1) = {1, 2}; Transfinite Curve{1} = 4;
a[] = Extrude{2.2, 0, 0}{ Line{1}; Layers{5}; Recombine; };
c[] = Extrude{0, 0, -0.5}{ Surface{a[1]}; Layers{2}; Recombine; };
Physical Surface("disc_face") = {a[1]};
Physical Surface("disc_low") = {c[0]};
Physical Volume("disc") = {c[1]};
)";
  return R"(
Point(101) = {0, 0, 0}; Point(102) = {0, 1, 0}; Line(101) = {101, 102};
Transfinite Curve{101} = 4;
d[] = Extrude{1, 0, 0}{ Line{101}; Layers{2}; Recombine; };
e[] = Extrude{1, 0, 0}{ Line{d[0]}; Layers{2}; Recombine; };
f[] = Extrude{0, 0, 0.5}{ Surface{d[1]}; Layers{2}; Recombine; };
g[] = Extrude{0, 0, 0.5}{ Surface{e[1]}; Layers{2}; Recombine; };
Physical Surface("left") = {d[1]};
Physical Surface("right") = {e[1]};
Physical Surface("both") = {d[1], e[1]};
Physical Surface("top") = {f[0], g[0]};
Physical Surface("top_left") = {f[0]};
Physical Volume("pad") = {f[1], g[1]};
)" + disc;
}

/// The normal and friction forces of all interfaces together, and the number of contact nodes.
struct Sums {
  mesh::Point normal{}, friction{};
  PetscInt nodes = 0;
  double area = 0;
};

Sums sumsWith(bool shared, const std::string& contact) {
  const std::string file =
      test::writeFile(shared ? "split_shared.geo" : "split_apart.geo", geometry(shared));
  test::setOptions("-mesh_file " + file + test::material("disc", "2e9", "0.3", "1000") +
                   test::material("pad", "1e9", "0.2", "1000") +
                   "-motion_disc_velocity 1,0.5,0 -constraint_disc_low_clamped xyz "
                   "-constraint_top_clamped xyz -constraint_top_displacement 0,0,-1e-4 "
                   "-load_top_left_pressure 1e5 " +
                   contact);
  const auto model = test::buildModel();
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const contact::CoupledSystem system(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  const auto solution = problem.solve({.friction = 0.4}, system);
  EXPECT_TRUE(solution.converged) << solution.reason;
  EXPECT_LT(solution.imbalance, 1e-10);
  Sums sums;
  for (const auto& resultant : solution.resultants) {
    sums.normal = mesh::plus(sums.normal, resultant.normalForce);
    sums.friction = mesh::plus(sums.friction, resultant.frictionForce);
  }
  sums.nodes = model.contact.interfaces.totalNodes;
  for (const auto& node : model.contact.interfaces.nodes) sums.area += node.area;
  sums.area = test::total(sums.area);
  return sums;
}

std::string interface(const std::string& name, const std::string& pad) {
  return "-contact_" + name + "_pad " + pad + " -contact_" + name + "_disc disc_face -contact_" +
         name + "_slave pad ";
}

TEST(SplitPad, IsOneContact) {
  for (const bool shared : {true, false}) {
    const Sums one = sumsWith(shared, interface("all", "both")),
               two = sumsWith(shared, interface("a", "left") + interface("b", "right"));
    EXPECT_EQ(two.nodes, one.nodes);
    EXPECT_NEAR(two.area / one.area, 1, 1e-12) << shared;
    // Node on node the problem is the same. Otherwise each interface weighs the nodes that they
    // share with its own faces, a difference of the order of the error of the mesh: 5e-5 here.
    const double tolerance = shared ? 1e-9 : 1e-3;
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(two.normal[d], one.normal[d], tolerance * mesh::length(one.normal)) << shared;
      EXPECT_NEAR(two.friction[d], one.friction[d], tolerance * mesh::length(one.normal)) << shared;
    }
  }
}

TEST(SplitPad, OtherwiseTheRemedyIsNamed) {
  const std::string finer =
      "-contact_a_pad left -contact_a_disc disc_face -contact_b_pad right "
      "-contact_b_disc disc_face -contact_a_slave disc -contact_b_slave disc";
  EXPECT_NE(test::errorOf([&] { sumsWith(false, finer); }).find("-contact_b_slave pad"),
            std::string::npos);
}

}  // namespace
}  // namespace squeal
