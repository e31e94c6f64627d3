// SPDX-License-Identifier: BSD-2-Clause
// Shapes of CAD programs: their labels are groups, they are meshed as asked, and solids that touch
// share nodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "model/element/shape.hpp"
#include "support/harness/messages.hpp"
#include "support/model/cad_shape.hpp"
#include "support/model/mesh_checks.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Mesh;

const std::string materials =
    test::material("disc", "1", "0.3", "1") + test::material("brake_pad", "1", "0.3", "1");

Mesh readShape(const std::string& file, const std::string& more) {
  test::setOptions("-mesh_file " + file + materials + more);
  return test::readMesh();
}

double volume(const Mesh& mesh, const std::string& body) {
  double sum = 0;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      if (mesh.bodies[block.body[e]] != body) continue;
      const auto x = [&](int i) { return mesh.coordinates[block.nodesOf(e)[i]]; };
      const auto edge = [&](int i) {  // straight tetrahedra: of their corners
        return mesh::Point{x(i)[0] - x(0)[0], x(i)[1] - x(0)[1], x(i)[2] - x(0)[2]};
      };
      const auto a = edge(1), b = edge(2), c = edge(3);
      sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
              a[2] * (b[0] * c[1] - b[1] * c[0])) /
             6;
    }
  return test::total(sum);
}

const char* const pressures = "-load_bottom_pressure 1 -load_top_pressure 1 -load_side_pressure 1 ";

TEST(Cad, LabelsAreGroups) {
  const Mesh mesh = readShape(test::plateAndBlock("labels.step"), pressures);
  EXPECT_EQ(element::shapeTable(mesh.cells.at(0).type).name, "tet10");
  EXPECT_NEAR(volume(mesh, "disc"), 1e5, 1e-6);
  EXPECT_NEAR(volume(mesh, "brake_pad"), 8e3, 1e-6);
  const auto areas = test::areaVectors(mesh);
  EXPECT_NEAR(areas.at("bottom")[2], -1e4, 1e-6);
  EXPECT_NEAR(areas.at("top")[2], 1600, 1e-6);
  EXPECT_NEAR(areas.at("side")[0], 0, 1e-6);  // both faces, with opposite normals
  double faces = 0;
  for (const auto& block : mesh.faces)
    for (int surface : block.surface) faces += mesh.surfaces[surface] == "side";
  EXPECT_GE(test::total(faces), 4);
}

// What has no label of its own is there by its number in the file, also after the cut.
TEST(Cad, EntitiesWithoutLabelHaveNumbers) {
  const auto areas = test::areaVectors(
      readShape(test::plateAndBlock("numbers.step"),
                "-load_face_1_pressure 1 -load_face_2_pressure 1 -load_face_4_pressure 1 "
                "-load_face_8_pressure 1 "));
  EXPECT_NEAR(areas.at("face_1")[0], -1000, 1e-6);  // both of the label `side`
  EXPECT_NEAR(areas.at("face_2")[0], 1000, 1e-6);
  EXPECT_NEAR(areas.at("face_4")[1], 1000, 1e-6);
  EXPECT_NEAR(areas.at("face_8")[0], 200, 1e-6);  // of the block
}

TEST(Cad, SolidsThatTouchShareNodes) {
  for (const std::string size : {"", "-mesh_size 6 "}) {
    const Mesh mesh = readShape(
        test::plateAndBlock("touch.step"),
        size + "-contact_c_pad face_11 -contact_c_disc face_6 -motion_disc_velocity 1,0,0");
    EXPECT_EQ(mesh.parts, 2);  // the contact is cut
    EXPECT_GE(test::total(static_cast<double>(mesh.pairs.size())), 9);
    const auto places = test::allCoordinates(mesh);
    for (const auto& pair : mesh.pairs) {
      const auto& x = mesh.coordinates[pair.node];
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_EQ(x[d], places[3 * static_cast<std::size_t>(pair.master) + d]);
      EXPECT_NEAR(x[2], 10, 1e-9);
      EXPECT_LE(std::max(std::abs(x[0] - 50), std::abs(x[1] - 50)), 20 + 1e-9);
    }
    EXPECT_NEAR(test::areaVectors(mesh).at("face_11")[2], -1600, 1e-6);
  }
}

/// The longest edge between corners, in the unit of the mesh.
double longestEdge(const Mesh& mesh) {
  double longest = 0;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) {
          const auto &a = mesh.coordinates[block.nodesOf(e)[i]],
                     &b = mesh.coordinates[block.nodesOf(e)[j]];
          longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
        }
  return test::largest(longest);
}

TEST(Cad, SizeOrderAndScale) {
  const auto file = test::plateAndBlock("size.step");
  const Mesh fine = readShape(file, "-mesh_size 8"),
             linear = readShape(file, "-mesh_size 8 -mesh_order 1");
  EXPECT_EQ(element::shapeTable(linear.cells.at(0).type).name, "tet4");
  EXPECT_EQ(linear.totalCells, fine.totalCells);
  // The edges on the curves are at most 8; those inside may be longer by a half.
  EXPECT_LE(longestEdge(fine), 12 * 1.2);
  EXPECT_GE(longestEdge(fine), 8 * 0.9);
  EXPECT_GT(fine.totalCells, 3 * readShape(file, "-mesh_size 20").totalCells);
  // The size is in the unit of the shape, whatever the scale.
  const Mesh metres = readShape(file, "-mesh_size 8 -mesh_scale 0.001");
  const auto a = test::allCoordinates(fine), b = test::allCoordinates(metres);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(b[i], 1e-3 * a[i], 1e-16);
}

// A STEP file in metres comes in millimetres too.
TEST(Cad, UnitsOfTheFile) {
  const auto metres = test::plateAndBlock("metres.step", "SI_UNIT($,.METRE.)");
  EXPECT_NEAR(volume(readShape(metres, "-mesh_scale 0.001"), "disc"), 1e5, 1e-6);
}

TEST(Cad, BrepHasNoLabels) {
  const auto file = test::plateAndBlock("plain.brep");
  test::setOptions("-mesh_file " + file + test::material("solid_1", "1", "0.3", "1") +
                   test::material("solid_2", "1", "0.3", "1"));
  const Mesh mesh = test::readMesh();
  EXPECT_NEAR(volume(mesh, "solid_1"), 1e5, 1e-6);
  EXPECT_NEAR(volume(mesh, "solid_2"), 8e3, 1e-6);
}

// The way to other groups: a geometry that merges the shape.
TEST(Cad, AGeometryMergesAShape) {
  test::plateAndBlock("merged.step");
  const auto file = test::writeFile("merging.geo", R"(
SetFactory("OpenCASCADE");
Merge "merged.step";
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Physical Volume("disc") = {1};
Physical Volume("brake pad") = {2};
below() = Surface In BoundingBox{-1, -1, -1, 101, 101, 1};
Physical Surface("bottom") = {below()};
Mesh.MeshSizeMax = 20;
)");
  const Mesh mesh = readShape(file, "-load_bottom_pressure 1");
  EXPECT_EQ(mesh.parts, 1);
  EXPECT_NEAR(volume(mesh, "disc"), 1e5, 1e-6);
  EXPECT_NEAR(test::areaVectors(mesh).at("bottom")[2], -1e4, 1e-6);
}

// The label of one face is the name that the program gives to another.
TEST(Cad, NumbersMustNotBeLabelsOfOthers) {
  const auto path = test::plateAndBlock("taken.step");
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  const auto taken = test::writeFile(
      "face_3.step", std::regex_replace(text.str(), std::regex("'bottom'"), "'face_3'"));
  test::expectMessage(test::messageOfMesh(taken, materials),
                      {"-mesh_file", "'face_3'", "number 3", "rename"});
}

TEST(Cad, ErrorsSayWhatIsThere) {
  const auto file = test::plateAndBlock("errors.step");
  const auto message = [](const std::string& of, const std::string& more) {
    return test::messageOfMesh(of, more);
  };
  test::expectMessage(message(file, materials + "-constraint_rim_clamped xyz"),
                      {"-constraint_rim_clamped", "'rim'", "bottom", "brake_pad", "disc", "face_11",
                       "side", "top"});
  test::expectMessage(message(file, test::material("disc", "1", "0.3", "1")),
                      {"'brake_pad'", "has no material"});
  test::expectMessage(message(file, materials + "-mesh_set n=2"), {"-mesh_set", ".geo"});
  test::expectMessage(message("meshes/beam.geo", "-mesh_size 2" + materials),
                      {"-mesh_size", "shapes", "beam.geo"});
  test::expectMessage(message("meshes/beam.geo", "-mesh_order 2" + materials), {"-mesh_order"});
  test::expectMessage(message(test::writeFile("empty.step", "ISO-10303-21;\n"), materials),
                      {"-mesh_file", "empty.step", "END-ISO-10303-21", "cut off"});
  test::expectMessage(message(test::writeFile("hollow.step",
                                              "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\n"
                                              "END-ISO-10303-21;\n"),
                              materials),
                      {"-mesh_file", "hollow.step"});
  test::expectMessage(message(test::writeFile("text.step", "Mesh 3;\n"), materials),
                      {"text.step", "ISO-10303-21"});
  test::expectMessage(message(test::writeFile("text.igs", "Mesh 3;\n"), materials), {"text.igs"});
}

}  // namespace
}  // namespace squeal
