// SPDX-License-Identifier: BSD-2-Clause
// G and K^R of moving bodies: D u = (V·∇)u of linear fields is exact, and so are its integrals on
// regular polygons and rectangles.
#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "support/algebra/symmetric.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using mesh::Point;
using test::form;
using test::largestEntry;

constexpr double density = 1.7, speed = 3;

/// Two rings of which the outer one turns; `cells` around.
std::string rings(int cells, const std::string& set, const std::string& more = {}) {
  return "-mesh_file meshes/cylinders.geo -mesh_set "
         "a=0.5,b=0.8,c=1.2,n_inner=2,n_outer=2,n_theta=" +
         std::to_string(cells) + "," + set + test::material("inner", "2", "0.3", "1") +
         test::material("outer", "2", "0.3", std::to_string(density)) +
         "-motion_outer_speed 3 -motion_convective on " + more;
}

/// A strip 3 × 0.5, periodic in x, that moves along x.
std::string strip(const std::string& set, const std::string& more = {}) {
  return "-mesh_file meshes/layer.geo -mesh_set Lx=3,h=0.5,nx=6,ny=2," + set +
         test::material("layer", "2", "0.3", std::to_string(density)) +
         "-constraint_right_image_of left -motion_layer_velocity 3,0 -motion_convective on " + more;
}

std::string solidRing(const std::string& set, const std::string& more = {}) {
  const std::string cells = test::contains(set, "n_theta") ? "" : "n_theta=16,";
  return "-mesh_file meshes/ring.geo -mesh_set R=1,thickness=0.4,width=0.3," + cells + set +
         test::material("ring", "2", "0.3", std::to_string(density)) +
         "-motion_ring_speed 3 -motion_convective on " + more;
}

TEST(Convection, GyroscopicMatrixIsSkewAndRotationStiffnessNegative) {
  for (const auto& options :
       {rings(12, "recombine=1"), rings(12, "recombine=0"), rings(24, "order=2"),
        strip("recombine=0"), strip("order=2,serendipity=1"), solidRing("n_r=1"),
        solidRing("order=2,n_theta=8")}) {
    SCOPED_TRACE(options);
    const auto [mesh, bodies] = test::buildBodies(options);
    const auto g = test::denseCopy(bodies.gyroscopic),
               k = test::denseCopy(bodies.rotationStiffness);
    for (PetscInt i = 0; i < g.rows(); ++i)
      for (PetscInt j = 0; j < g.rows(); ++j)
        ASSERT_TRUE(g(i, j) == -g(j, i) && k(i, j) == k(j, i)) << i << " " << j;
    EXPECT_GT(largestEntry(g), 0);
    const auto values = linalg::symmetricEigenvalues(k);
    EXPECT_LT(values.front(), 0);
    EXPECT_LT(values.back(), -1e-13 * values.front());  // rounding
  }
}

TEST(Convection, RigidTranslationCostsNothing) {
  for (const auto& options :
       {rings(12, "recombine=0"), strip("order=2"), solidRing("order=2,serendipity=1,n_theta=8")}) {
    const auto [mesh, bodies] = test::buildBodies(options);
    const auto u = test::nodalField(mesh, [](const Point&) { return Point{1, -2, 0.5}; });
    OwnedVec force = elasticity::nodalVector(mesh);
    check(MatMult(bodies.rotationStiffness, u, force));
    PetscReal size = 0;
    check(VecNorm(force, NORM_INFINITY, &size));
    EXPECT_LT(size, 1e-13 * largestEntry(test::denseCopy(bodies.rotationStiffness))) << options;
  }
}

/// u = H x with nothing special about H.
Point linear(const double (&h)[2][2], const Point& x) {
  return {h[0][0] * x[0] + h[0][1] * x[1], h[1][0] * x[0] + h[1][1] * x[1], 0};
}
constexpr double h1[2][2] = {{0.31, -0.52}, {0.23, -0.14}},
                 h2[2][2] = {{-0.44, 0.71}, {0.65, 0.27}};
OwnedVec linearField(const mesh::Mesh& mesh, const double (&h)[2][2]) {
  return test::nodalField(mesh, [&](const Point& x) { return linear(h, x); });
}

/// ∫ |x|² over a regular polygon of n corners on the circle of radius R: n triangles A/6 (|P|² +
/// |Q|² + P·Q).
double polarMoment(int n, double radius) {
  const double angle = 2 * M_PI / n;
  return n / 12.0 * std::pow(radius, 4) * std::sin(angle) * (2 + std::cos(angle));
}

// vᵀ G u = ∫ ρ ((Du)·v − (Dv)·u), uᵀ K^R u = −∫ ρ |Du|². On the rings D (H x) = ω H J x, J x = k ×
// x, and ∫ x xᵀ = I/2 1.
TEST(Convection, LinearFieldsOnRings) {
  for (const char* set : {"recombine=1", "recombine=0"}) {
    const auto [mesh, bodies] = test::buildBodies(rings(12, set));
    const double half = density * (polarMoment(12, 1.2) - polarMoment(12, 0.8)) / 2;
    double gyroscopic = 0, stiffness = 0;
    for (int i = 0; i < 2; ++i) {
      const double d1[] = {speed * h1[i][1], -speed * h1[i][0]},
                   d2[] = {speed * h2[i][1], -speed * h2[i][0]};  // ω H J
      for (int j = 0; j < 2; ++j)
        gyroscopic += half * (d1[j] * h2[i][j] - d2[j] * h1[i][j]),
            stiffness -= half * d1[j] * d1[j];
    }
    const auto u = linearField(mesh, h1), v = linearField(mesh, h2);
    EXPECT_NEAR(form(v, bodies.gyroscopic, u), gyroscopic, 1e-12 * std::abs(gyroscopic)) << set;
    EXPECT_NEAR(form(u, bodies.rotationStiffness, u), stiffness, -1e-12 * stiffness) << set;
  }
}

// The same on the strip, V = 3 e_x, its centre at (1.5, −0.25): D (H x) = 3 H e_x.
TEST(Convection, LinearFieldsOnStrip) {
  for (const char* set :
       {"recombine=1", "recombine=0", "order=2", "order=2,recombine=0", "order=2,serendipity=1"}) {
    const auto [mesh, bodies] = test::buildBodies(strip(set));
    const Point e{1, 0, 0}, centre{1.5, -0.25, 0};
    const double factor = density * 1.5 * speed;
    const double gyroscopic = factor * (test::dot(linear(h1, e), linear(h2, centre)) -
                                        test::dot(linear(h2, e), linear(h1, centre)));
    const double stiffness = -factor * speed * test::dot(linear(h1, e), linear(h1, e));
    const auto u = linearField(mesh, h1), v = linearField(mesh, h2);
    EXPECT_NEAR(form(v, bodies.gyroscopic, u), gyroscopic, 1e-12 * std::abs(gyroscopic)) << set;
    EXPECT_NEAR(form(u, bodies.rotationStiffness, u), stiffness, -1e-12 * stiffness) << set;
  }
}

// u = k × r: Du = −ω r, so uᵀ K^R u = −ω² J with the moment of inertia J = uᵀ M u of the mesh
// itself.
TEST(Convection, RigidRotationCostsItsMomentOfInertia) {
  const std::string both = "-material_inner_density 2.3 -motion_inner_speed 3 ";
  for (const auto& options :
       {rings(12, "recombine=0", both), rings(24, "order=2,recombine=0", both), solidRing("n_z=2"),
        solidRing("order=2,n_theta=8"), solidRing("order=2,serendipity=1,n_theta=8")}) {
    const auto [mesh, bodies] = test::buildBodies(options);
    const auto u = test::nodalField(mesh, [&](const Point& x) { return Point{-x[1], x[0], 0}; });
    const double expected = -speed * speed * form(u, bodies.mass, u);
    EXPECT_NEAR(form(u, bodies.rotationStiffness, u), expected, -1e-12 * expected) << options;
  }
}

/// A circular ring of unstructured cells about z, or with `square` a square one; a solid one if
/// `depth` > 0.
std::string unstructured(const std::string& name, int cells, int order, double depth, bool square) {
  std::string text = "Point(1) = {0, 0, 0};\n";
  for (int side = 0; side < 2; ++side)
    for (int q = 0; q < 4; ++q)
      text += formatted("Point(%d) = {%g, %g, 0};\n", 10 + 10 * side + q,
                        (0.4 + 0.6 * side) * (q % 2 ? 0 : 1 - q),
                        (0.4 + 0.6 * side) * (q % 2 ? 2 - q : 0));
  for (int side = 0; side < 2; ++side)
    for (int q = 0; q < 4; ++q) {
      const int curve = 10 + 10 * side + q, next = 10 + 10 * side + (q + 1) % 4;
      text += formatted(square && side ? "Line(%d) = {%d, %d};\n" : "Circle(%d) = {%d, 1, %d};\n",
                        curve, curve, next);
      text += formatted("Transfinite Curve {%d} = %d;\n", curve, cells / 4 + 1);
    }
  text += "Curve Loop(1) = {20:23};\nCurve Loop(2) = {10:13};\nPlane Surface(1) = {1, 2};\n";
  text += depth > 0
              ? formatted("Extrude {0, 0, %g} { Surface{1}; }\nPhysical Volume(\"body\") = {1};\n",
                          depth)
              : std::string("Physical Surface(\"body\") = {1};\n");
  text += formatted("Mesh.MeshSizeMax = %g;\nMesh.ElementOrder = %d;\n", 2 * M_PI / cells, order);
  return test::writeFile(name + ".geo", text);
}

std::string bodyOf(const std::string& file, const std::string& motion) {
  return "-mesh_file " + file + test::material("body", "2", "0.3", "1") + "-motion_convective on " +
         motion;
}

TEST(Convection, MatterCrossesTheSurfaceOfWhatIsNotOfRevolution) {
  const std::string spin = "-motion_body_rpm 60 ";
  for (const int cells : {12, 36})
    for (const int order : {1, 2})
      for (const double depth : {0.0, 0.5}) {
        if (order == 2 && depth > 0 && cells > 12) continue;  // more of the same
        SCOPED_TRACE(formatted("%d cells around, order %d, depth %g", cells, order, depth));
        EXPECT_EQ(
            test::errorOf([&] {
              test::buildBodies(bodyOf(unstructured("round", cells, order, depth, false), spin));
            }),
            "");
        const auto file = unstructured("square", cells, order, depth, true);
        const auto message = test::errorOf([&] { test::buildBodies(bodyOf(file, spin)); });
        EXPECT_TRUE(test::contains(message,
                                   "-motion_convective: body 'body' is not a figure of revolution"))
            << message;
        EXPECT_TRUE(test::contains(message, "approximation A")) << message;
      }
  const auto round = unstructured("round", 36, 1, 0, false);
  EXPECT_NE(
      test::errorOf([&] { test::buildBodies(bodyOf(round, spin + "-motion_body_origin 0.1,0")); }),
      "");  // off its axis
  EXPECT_NE(test::errorOf([&] { test::buildBodies(bodyOf(round, "-motion_body_velocity 1,0")); }),
            "");
  EXPECT_EQ(test::errorOf([&] { test::buildBodies(strip("order=2")); }), "");
  EXPECT_NE(
      test::errorOf([&] { test::buildBodies(strip("order=2", "-motion_layer_velocity 3,0.1 ")); }),
      "");
}

TEST(Convection, IsThereOnlyIfWantedAndMoving) {
  for (const std::string more : {"-motion_convective off", "-motion_outer_speed 0"}) {
    const auto [mesh, bodies] = test::buildBodies(rings(12, "recombine=1", more));
    EXPECT_FALSE(bodies.gyroscopic || bodies.rotationStiffness) << more;
  }
}

TEST(Motion, RevolutionsPerMinute) {
  test::setOptions("-motion_disc_rpm 90 ");
  const auto settings = elasticity::Settings::given();
  EXPECT_NEAR(elasticity::motionsOf({"disc"}, 2, settings.motions).front().speed, 3 * M_PI, 1e-14);
  EXPECT_EQ(elasticity::movingBodies(settings), std::vector<std::string>{"disc"});
  test::setOptions("-motion_disc_rpm 90 -motion_disc_speed 3");
  EXPECT_TRUE(
      test::contains(test::errorOf([] { elasticity::Settings::given(); }), "-motion_disc_rpm"));
  test::setOptions("-motion_disc_rpm 90 -motion_disc_velocity 1,0");
  EXPECT_TRUE(test::contains(test::errorOf([] { elasticity::Settings::given(); }), "not both"));
}

}  // namespace
}  // namespace squeal
