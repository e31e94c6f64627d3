// SPDX-License-Identifier: BSD-2-Clause
// The visible surface: areas and mean squares of normal velocities of bodies whose faces are known.
#include "regime/sound/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "model/elasticity/boundary.hpp"
#include "model/elasticity/face.hpp"
#include "support/model/element_patch.hpp"
#include "support/model/model.hpp"
#include "support/model/steel_brake.hpp"

namespace squeal {
namespace {

using test::form;
using test::nodalField;
using test::patch::Patch;

INSTANTIATE_TEST_SUITE_P(Elements, Patch, testing::ValuesIn(test::patch::elements),
                         [](const auto& info) { return std::string(info.param.label); });

// Of the unit square or cube: its four sides or six faces, and by the theorem of Gauss
// ∫ x·n dA = dimension × volume, to which a normal that points inwards adds its part negatively.
TEST_P(Patch, BoundaryOfTheUnitCell) {
  build();
  double sums[2] = {0, 0};
  for (const auto& face : elasticity::boundaryFaces(mesh)) {
    const auto& table = element::shapeTable(face.type);
    std::vector<mesh::Point> points;
    for (const PetscInt node : face.nodes) points.push_back(mesh.coordinates[node]);
    for (const double weight : elasticity::areaWeights(table, points)) sums[0] += weight;
    const auto normals = elasticity::faceNormals(table, points, face.sign);
    for (std::size_t i = 0; i < normals.size(); ++i) sums[1] += normals[i] * points[i / 3][i % 3];
  }
  check(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  EXPECT_NEAR(sums[0], 2 * dimension(), 1e-12);
  EXPECT_NEAR(sums[1], dimension(), 1e-12);
}

std::string beam(const std::string& cells = {}) {
  return "-mesh_file meshes/beam.geo -mesh_set Lx=2,Ly=0.3,Lz=0.5,nx=4,ny=2,nz=2" + cells +
         test::material("beam", "1", "0.3", "1") + "-constraint_clamped_clamped xyz ";
}

// A piston: of a uniform velocity along x the tip alone radiates; the velocity x along y gives
// ∫ x² dA = L³/3 times the height on both sides, which quadratic cells integrate exactly.
TEST(Surface, OfABox) {
  for (const std::string cells : {",order=2", ",order=2,recombine=0", ",order=2,serendipity=1"}) {
    test::setOptions(beam(cells));
    const auto model = test::buildModel();
    const auto surface = sound::radiatingSurface(*model.mesh, model.contact);
    EXPECT_NEAR(surface.area, 0.3 * 0.5 + 2 * 2 * (0.3 + 0.5), 1e-12);
    const auto integral = [&](const auto& field) {
      const OwnedVec v = nodalField(*model.mesh, field);
      return form(v, surface.normalMass, v);
    };
    using mesh::Point;
    EXPECT_NEAR(integral([](const Point&) { return Point{1, 0, 0}; }), 0.3 * 0.5, 1e-12);
    EXPECT_NEAR(integral([](const Point&) { return Point{0, 1, 0}; }), 2 * 2 * 0.5, 1e-12);
    EXPECT_NEAR(integral([](const Point& x) {
                  return Point{0, x[0], 0};
                }),
                2 * 8 / 3.0 * 0.5, 1e-12);
    // Shear along the faces is silent, except at the bottom and top, where v_n = x.
    EXPECT_NEAR(integral([](const Point& x) {
                  return Point{0, 0, x[0]};
                }),
                2 * 8 / 3.0 * 0.3, 1e-12);
    for (PetscInt node = 0; node < model.mesh->ownedNodes; ++node) {
      const Point& x = model.mesh->coordinates[node];
      const bool inside = std::abs(x[1]) < 0.1499 && std::abs(x[2]) < 0.2499 && x[0] < 1.999;
      EXPECT_EQ(surface.has(node), !inside);
      if (x[0] > 1.999 && std::abs(x[1]) < 0.1499 && std::abs(x[2]) < 0.2499) {
        EXPECT_NEAR(surface.normals[node][0], 1, 1e-12);
      }
    }
  }
}

// A support along y silences the sides whose normal is y, and hides no other.
TEST(Surface, WhatSupportsHoldAlongTheNormalIsHidden) {
  test::setOptions(beam() + "-constraint_right_clamped y -constraint_top_clamped x");
  const auto model = test::buildModel();
  EXPECT_NEAR(sound::radiatingSurface(*model.mesh, model.contact).area,
              0.3 * 0.5 + 2 * 2 * (0.3 + 0.5) - 2 * 0.5, 1e-12);
}

// The layers are cut at the left and at the right, where images repeat, and clamped below and
// above. They touch over all of their length; without the contact above, a pad on springs is seen
// there.
TEST(Surface, OfPeriodicLayers) {
  const std::string layers =
      "-mesh_file meshes/two_layers.geo -mesh_set nx=6,ny_disc=3,ny_pad=2 -motion_disc_velocity "
      "1,0,0 -constraint_disc_bottom_clamped xy -constraint_disc_right_image_of disc_left "
      "-constraint_pad_right_image_of pad_left -contact_pair_pad pad_face -contact_pair_disc "
      "disc_face " +
      test::material("disc", "1", "0.3", "1") + test::material("pad", "1", "0.3", "1");
  for (const auto& [above, area, nodes] :
       {std::tuple{"-constraint_pad_top_clamped xy", 0, 0}, {"-ground_pad_stiffness 3,0", 3, 7}}) {
    test::setOptions(layers + above);
    const auto model = test::buildModel();
    const auto surface = sound::radiatingSurface(*model.mesh, model.contact);
    EXPECT_NEAR(surface.area, area, 1e-11) << above;
    PetscInt seen = 0;
    for (PetscInt node = 0; node < model.mesh->ownedNodes; ++node) seen += surface.has(node);
    check(MPI_Allreduce(MPI_IN_PLACE, &seen, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
    EXPECT_EQ(seen, nodes) << above;
  }
}

// What is under the pads is in contact, though disc and pads share its nodes in the file.
TEST(Surface, OfADiscBetweenTwoPads) {
  test::setOptions(test::steel_brake::options(2, 0.022, 1e6));
  const auto model = test::buildModel();
  const double inner = 0.06, outer = 0.15, h = 0.02, pad = test::steel_brake::padArea;
  const double sides = 0.015 * (M_PI / 3 * (0.145 + 0.085) + 2 * (0.145 - 0.085));
  const double disc = 2 * M_PI * (outer * outer - inner * inner) + 2 * M_PI * outer * h - 2 * pad;
  const double area = disc + 2 * (pad + sides);
  EXPECT_NEAR(sound::radiatingSurface(*model.mesh, model.contact).area, area, 2e-3 * area);
}

// A box of 1 × 1 × 0.5 in the middle of one of 2 × 2 × 0.5, with other meshes: all nodes of the
// lower faces that it covers are masters, or slaves; tied or in contact.
TEST(Surface, OfBoxesWhoseMeshesDiffer) {
  const auto file = test::writeFile(program_invocation_short_name + std::string("_boxes.geo"), R"(
SetFactory("OpenCASCADE");
Box(1) = {-1, -1, -0.5, 2, 2, 0.5};
Box(2) = {-0.5, -0.5, 0, 1, 1, 0.5};
Transfinite Curve{1 : 12} = 9;
Transfinite Curve{13 : 24} = 4;
Transfinite Surface{1 : 12};
Recombine Surface{1 : 12};
Transfinite Volume{1, 2};
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
Physical Surface("lower_face") = {6};
Physical Surface("bottom") = {5};
Physical Surface("upper_face") = {11};
Physical Surface("top") = {12};
)");
  const std::string boxes = "-mesh_file " + file + test::material("lower", "1", "0.3", "1") +
                            test::material("upper", "1", "0.3", "1") +
                            "-constraint_bottom_clamped xyz ";
  for (const std::string contact :
       {"-tie_pair_slave upper_face -tie_pair_master lower_face",
        "-contact_pair_pad upper_face -contact_pair_disc lower_face -motion_lower_velocity 1,0,0 "
        "-ground_upper_stiffness 1,1,0"}) {
    test::setOptions(boxes + contact);
    const auto model = test::buildModel();
    const double area = 4 * 2 * 0.5 + (4 - 1) + 4 * 0.5 + 1;
    EXPECT_NEAR(sound::radiatingSurface(*model.mesh, model.contact).area, area, 1e-12) << contact;
  }
}

}  // namespace
}  // namespace squeal
