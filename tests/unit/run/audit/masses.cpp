// SPDX-License-Identifier: BSD-2-Clause
// Masses, centres and moments of inertia in closed form.
#include "run/audit/masses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/model/blocks_apart.hpp"
#include "support/run/audited.hpp"

namespace squeal {
namespace {

using audit::BodyMass;
using mesh::Point;
using test::Block;

constexpr double density = 7800;

/// Collective. Returns the bodies of the options, without contact.
std::vector<BodyMass> massesOf(const std::string& options) {
  const auto built = test::buildBodies(options);
  const contact::Contact none;
  return audit::bodyMasses({built.mesh, built.bodies, none, {}, {}});
}

/// Returns the mass of a box with these sides; of a rectangle in the plane if the last is zero.
double massOf(const Point& sides) {
  return density * sides[0] * sides[1] * (sides[2] > 0 ? sides[2] : 1);
}

/// m/12 (b² + c²) about the axis a.
void expectInertia(const BodyMass& body, const Point& sides, double tolerance) {
  const auto square = [](double x) { return x * x; };
  const double scale = body.mass * mesh::dot(sides, sides);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      EXPECT_NEAR(
          body.inertia[a][b],
          a == b ? body.mass / 12 * (square(sides[(a + 1) % 3]) + square(sides[(a + 2) % 3])) : 0,
          tolerance * scale)
          << a << b;
}

TEST(Masses, Box) {
  for (const int cell : test::solidCells) {
    test::BlockWriter writer;
    // Far from the origin, where moments about it would lose digits.
    writer.add("box", {cell, {3, 2, 2}, {1000.1, -20, 5}, {1000.3, -19.5, 5.04}});
    const auto masses = massesOf("-mesh_file " + test::writeFile("audit_box.msh", writer.text()) +
                                 test::material("box", "2e11", "0.3", "7800"));
    ASSERT_EQ(masses.size(), 1u);
    const auto& box = masses[0];
    const Point sides{0.2, 0.5, 0.04};
    EXPECT_EQ(box.body, "box");
    EXPECT_NEAR(box.mass, massOf(sides), 1e-10 * massOf(sides));
    const Point centre{1000.2, -19.75, 5.02};
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(box.centre[d], centre[d], 1e-10);
      EXPECT_NEAR(box.high[d] - box.low[d], sides[d], 1e-10);
    }
    expectInertia(box, sides, 1e-10);
  }
}

// Two plies of 1 × 0.8 and 0.3 and 0.5 thick, with densities 2 and 6: the sum of two boxes.
TEST(Masses, BodyOfTwoSections) {
  const auto masses = massesOf(
      "-mesh_file meshes/laminate.geo -material_plate_sections lower,upper -material_plate_young 1 "
      "-material_plate_poisson 0.3 -material_lower_density 2 -material_upper_density 6");
  ASSERT_EQ(masses.size(), 1u);
  const auto& plate = masses[0];
  const double low = 2 * 0.8 * 0.3, high = 6 * 0.8 * 0.5,
               z = (0.15 * low + 0.55 * high) / (low + high);
  EXPECT_EQ(plate.body, "plate");
  EXPECT_EQ(plate.cells, 4 * 3 * 5);
  EXPECT_NEAR(plate.volume, 0.64, 1e-12);
  EXPECT_NEAR(plate.mass, low + high, 1e-12);
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(plate.centre[d], (Point{0.5, 0.4, z}[d]), 1e-12);
  const double across =
      low * (0.09 / 12 + std::pow(z - 0.15, 2)) + high * (0.25 / 12 + std::pow(z - 0.55, 2));
  EXPECT_NEAR(plate.inertia[0][0], plate.mass * 0.64 / 12 + across, 1e-12);
  EXPECT_NEAR(plate.inertia[1][1], plate.mass / 12 + across, 1e-12);
  EXPECT_NEAR(plate.inertia[2][2], plate.mass * 1.64 / 12, 1e-12);
  EXPECT_NEAR(plate.inertia[0][1], 0, 1e-12);
}

TEST(Masses, RectangleInThePlane) {
  test::BlockWriter writer;
  writer.add("plate", {3, {4, 1, 3}, {1, 0, 2}, {3, 0, 2.5}});
  const auto masses = massesOf("-mesh_file " + test::writeFile("audit_plane.msh", writer.text()) +
                               test::material("plate", "2e11", "0.3", "7800"));
  const Point sides{2, 0.5, 0};
  EXPECT_NEAR(masses.at(0).mass, massOf(sides), 1e-9);
  EXPECT_NEAR(masses[0].centre[0], 2, 1e-12);
  EXPECT_NEAR(masses[0].centre[1], 2.25, 1e-12);
  expectInertia(masses[0], sides, 1e-12);
}

// Two boxes that form one: the theorem of parallel axes.
TEST(Masses, TotalOfTwoBoxes) {
  const auto options =
      test::blocksApart("audit_total.msh", {test::hex8, {2, 2, 2}, {0, 0, -0.5}, {1, 1, 0}},
                        {test::hex8, {3, 2, 1}, {0, 0, 0}, {1, 1, 0.25}});
  const auto masses = massesOf(options.substr(0, options.find("-contact_")) +
                               "-material_pad_density 7800 -material_disc_density 7800");
  const auto total = audit::totalOf(masses);
  const Point sides{1, 1, 0.75};
  EXPECT_EQ(total.cells, 14);
  EXPECT_NEAR(total.mass, massOf(sides), 1e-9);
  EXPECT_NEAR(total.centre[2], -0.125, 1e-12);
  expectInertia(total, sides, 1e-12);
}

// I_zz = m/2 (r² + R²), I_xx = m/12 (3 (r² + R²) + w²). Quadratic cells approximate the circle to
// the fourth order of their angle.
TEST(Masses, Ring) {
  const auto masses = massesOf("-mesh_file meshes/ring.geo -mesh_set order=2,n_theta=64" +
                               test::material("ring", "2e11", "0.3", "7800"));
  const double inner = 0.099, outer = 0.101, width = 0.003;
  const double squares = inner * inner + outer * outer;
  const double mass = density * M_PI * (outer * outer - inner * inner) * width;
  const auto& ring = masses.at(0);
  EXPECT_NEAR(ring.mass, mass, 1e-6 * mass);
  for (const double x : ring.centre) EXPECT_NEAR(x, 0, 1e-12);
  EXPECT_NEAR(ring.inertia[2][2], mass / 2 * squares, 2e-6 * mass * squares);
  for (std::size_t d = 0; d < 2; ++d)
    EXPECT_NEAR(ring.inertia[d][d], mass / 12 * (3 * squares + width * width),
                2e-6 * mass * squares);
  EXPECT_NEAR(ring.inertia[0][1], 0, 1e-12 * mass * squares);
}

// A dumbbell of two point masses and a light block: the masses at the nodes of a face, and one at a
// reference node in turned axes.
TEST(Masses, PointMasses) {
  test::BlockWriter writer;
  writer.add("box", {test::hex8, {1, 1, 2}, {-1, -1, -1}, {1, 1, 1}, 0});
  const auto audit = test::audited(
      "-mesh_file " + test::writeFile("audit_points.msh", writer.text()) +
      test::material("box", "1", "0.3", "0.125") +
      "-constraint_box_low_clamped xyz -mass_box_high_total 4 -reference_r_position 0,0,3 "
      "-coupling_c_reference r -coupling_c_nodes box_x1 -mass_r_total 5 -mass_r_offset 2,0,0 "
      "-mass_r_inertia 1,2,3,0,0,0 -mass_r_frame f -frame_f_x 0,1,0 -frame_f_xy -1,0,0");
  ASSERT_EQ(audit.points.size(), 2u);
  const auto &face = audit.points[0], &point = audit.points[1];
  EXPECT_EQ(face.body, "mass of 'box_high'");
  EXPECT_NEAR(face.mass, 4, 1e-12);
  EXPECT_NEAR(face.centre[2], 1, 1e-12);
  EXPECT_NEAR(face.inertia[0][0], 4, 1e-12);  // four nodes at (±1, ±1, 1)
  EXPECT_NEAR(face.inertia[2][2], 8, 1e-12);
  EXPECT_EQ(point.body, "mass of 'r'");
  EXPECT_NEAR(point.centre[0], 0, 1e-12);
  EXPECT_NEAR(point.centre[1], 2, 1e-12);
  EXPECT_NEAR(point.centre[2], 3, 1e-12);
  EXPECT_NEAR(point.inertia[0][0], 2, 1e-12);
  EXPECT_NEAR(point.inertia[1][1], 1, 1e-12);
  EXPECT_NEAR(point.inertia[2][2], 3, 1e-12);
  EXPECT_NEAR(audit.total.mass, 10, 1e-12);
  EXPECT_NEAR(audit.total.centre[2], (4 * 1 + 5 * 3) / 10.0, 1e-12);
  EXPECT_NEAR(audit.total.centre[1], 1, 1e-12);
  ASSERT_EQ(audit.parts.size(), 2u);  // the block and the reference node
  const auto holds = [&](const audit::PartSupports& part, const std::string& by) {
    return std::ranges::any_of(part.supports,
                               [&](const audit::Support& support) { return support.by == by; });
  };
  for (const auto& part : audit.parts) {
    EXPECT_TRUE(holds(part, "coupling 'c'")) << part.part;
    EXPECT_FALSE(part.needsContact) << part.part;
  }
}

}  // namespace
}  // namespace squeal
