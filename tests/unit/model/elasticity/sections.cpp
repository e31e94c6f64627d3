// SPDX-License-Identifier: BSD-2-Clause
// Bodies made up of sections: one law in two sections is one body, two laws are two bodies that
// share nodes, and wrong sections are refused. Axes of materials by frames.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/system/text.hpp"
#include "exact/orthotropic.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/sparse.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/ranks.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Matrix3;
using mesh::Point;
using test::contains;

/// The cells of all types: hex8, hex20, hex27, tet4, tet10, wedge6, wedge15.
const std::vector<std::string> cellSets{"n=1",
                                        "order=2,serendipity=1",
                                        "order=2",
                                        "recombine=0",
                                        "recombine=0,order=2",
                                        "recombine=0,wedge=1",
                                        "recombine=0,wedge=1,order=2,serendipity=1"};

/// Collective. Returns the options of the cube of distorted cells with its halves at x < 0.5 and
/// x > 0.5 as further groups; the cube itself is the group `body`.
std::string halves(const std::string& set) {
  const std::string file = test::writeFile(
      "halves.geo", "Include \"" + std::filesystem::absolute("meshes/patch_3d.geo").string() +
                        "\";\nPhysical Volume(\"left\") = {8001, 8011, 8101, 8111};\n"
                        "Physical Volume(\"right\") = {8002, 8012, 8102, 8112};\n");
  return "-mesh_file " + file + " -mesh_set " + set + " ";
}

double difference(Mat one, Mat other) {
  const auto a = test::denseCopy(one), b = test::denseCopy(other);
  return test::largestDifference(a, b) / test::largestEntry(a);
}

double difference(Vec one, Vec other) {
  const auto a = test::allEntries(one), b = test::allEntries(other);
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(a[i] - b[i])), size = std::max(size, std::abs(a[i]));
  return worst / size;
}

// Ranks add their contributions in any order, so the last digit may differ on two of them.
constexpr double rounding = 1e-15;
/// Where the cells, and so the nodes of the sums, come in another order.
constexpr double reordered = 1e-13;

const std::string law = test::material("body", "3", "0.3", "1.7") +
                        "-material_body_rayleigh_mass 0.4 -material_body_rayleigh_stiffness 0.2 ";

TEST(Sections, OneLawIsOneBody) {
  for (const auto& set : cellSets) {
    const auto one = test::buildBodies(halves(set) + law),
               two = test::buildBodies(halves(set) + law + "-material_body_sections left,right");
    EXPECT_EQ(two.mesh.bodies, (std::vector<std::string>{"body"}));
    EXPECT_EQ(two.bodies.materials.size(), 2u);
    EXPECT_FALSE(one.mesh.hasSections());
    EXPECT_TRUE(two.mesh.hasSections());
    EXPECT_LE(difference(one.bodies.stiffness, two.bodies.stiffness), rounding) << set;
    EXPECT_LE(difference(one.bodies.mass, two.bodies.mass), rounding) << set;
    EXPECT_LE(difference(one.bodies.damping, two.bodies.damping), rounding) << set;
  }
}

// A cell belongs to the half that contains its middle, on any number of ranks.
TEST(Sections, CellsHaveTheMaterialOfTheirSection) {
  for (const std::string body : {"body", "whole"})  // a group of the mesh, or only of options
    for (const std::string list : {"left,right", "right,left"}) {
      test::setOptions(halves("n=2") + test::material(body, "3", "0.3", "1.7") + "-material_" +
                       body + "_sections " + list);
      const auto mesh = test::readMesh();
      double cells = 0;
      for (const auto& block : mesh.cells)
        for (std::size_t e = 0; e < block.tag.size(); ++e, ++cells) {
          double x = 0;
          for (const PetscInt node : block.nodesOf(e))
            x += mesh.coordinates[node][0] / block.nodesPerCell;
          EXPECT_EQ(mesh.materialGroups.at(block.material[e]).name, x < 0.5 ? "left" : "right");
          EXPECT_EQ(
              mesh.materialText(block.material[e]),
              formatted("section '%s' of body '%s'", x < 0.5 ? "left" : "right", body.c_str()));
        }
      EXPECT_EQ(test::total(cells), 64);
    }
}

/// The laws of the halves: orthotropic and general ones, and options of the body that one of the
/// sections replaces.
std::string lawsOf(const std::string& left, const std::string& right, const std::string& set) {
  const std::string reduced = "_integration reduced ";
  const bool hex20 = set == "order=2,serendipity=1";
  const auto both = [&](const std::string& rest) {
    return "-material_" + left + rest + (left == right ? "" : "-material_" + right + rest);
  };
  return "-material_left_engineering_constants " + std::string(exact::orthotropic::constants) +
         " -material_left_orientation 1,0.5,0.2,-0.3,1,0.4 "
         "-material_right_orthotropic 3,1,2.5,0.9,0.7,2,0.8,0.6,1.1 -material_right_frame f "
         "-frame_f_axis 1,2,3 -frame_f_origin 0.1,-0.2,0 " +
         both("_density 1.7 ") + both("_rayleigh_mass 0.4 ") +
         "-material_right_loss_factor 0.1 -material_right_loss_frequency 2 " +
         (hex20 ? "-material_left" + reduced : "");
}

OwnedVec field(const mesh::Mesh& mesh) {
  return test::nodalField(mesh, [](const Point& x) {
    return Point{0.1 * x[0] + 0.2 * x[1] * x[2], 0.3 * x[1] - 0.1 * x[0] * x[0], 0.2 * x[2]};
  });
}

TEST(Sections, TwoLawsAreTwoBodiesThatShareNodes) {
  const std::string loads = "-load_gravity 1,2,-3 ";
  for (const auto& set : cellSets) {
    SCOPED_TRACE(set);
    // The sections of a body without a group come in their order, as bodies do.
    const auto one = test::buildBodies(
                   halves(set) + loads + lawsOf("left", "right", set) +
                   "-load_left_spin 2 -load_left_spin_axis 1,0,0 -load_right_spin 2 "
                   "-load_right_spin_axis 1,0,0"),
               two = test::buildBodies(halves(set) + loads + lawsOf("whole", "whole", set) +
                                       "-material_whole_sections left,right -load_whole_spin 2 "
                                       "-load_whole_spin_axis 1,0,0");
    EXPECT_LE(difference(one.bodies.stiffness, two.bodies.stiffness), rounding);
    EXPECT_LE(difference(one.bodies.mass, two.bodies.mass), rounding);
    EXPECT_LE(difference(one.bodies.damping, two.bodies.damping), rounding);
    EXPECT_LE(difference(one.bodies.load, two.bodies.load), rounding);
    const OwnedMat stressOne =
                       elasticity::geometricStiffness(one.mesh, one.bodies, field(one.mesh)),
                   stressTwo =
                       elasticity::geometricStiffness(two.mesh, two.bodies, field(two.mesh));
    EXPECT_LE(difference(stressOne, stressTwo), rounding);
    for (const int group : {0, 1}) {
      const auto a = elasticity::materialPart(one.mesh, one.bodies, group),
                 b = elasticity::materialPart(two.mesh, two.bodies, group);
      EXPECT_LE(difference(a.stiffness, b.stiffness), rounding);
      EXPECT_LE(difference(a.mass, b.mass), rounding);
      EXPECT_LE(difference(a.weight, b.weight), rounding);
      EXPECT_EQ(a.massDamping, b.massDamping);
      EXPECT_EQ(a.stiffnessDamping, b.stiffnessDamping);
      const OwnedMat ofOne = elasticity::geometricStiffness(one.mesh, one.bodies, field(one.mesh),
                                                            group),
                     ofTwo = elasticity::geometricStiffness(two.mesh, two.bodies, field(two.mesh),
                                                            group);
      EXPECT_LE(difference(ofOne, ofTwo), rounding);
    }
  }
}

// Plies side by side, stretched alike: the energy of u = ε x is that of the parts, Σ V_i ε:D_i:ε.
TEST(Sections, PliesInParallel) {
  const std::string laminate =
      "-mesh_file meshes/laminate.geo -material_plate_sections lower,upper "
      "-material_plate_density 1 ";
  const auto lower = exact::orthotropic::constants;
  const Matrix3 stress{{{0.7, -0.4, 0.9}, {-0.4, 1.1, 0.6}, {0.9, 0.6, -0.5}}};
  // In the lower ply axis 1 is along y and 2 along −x; the upper one is isotropic.
  const Matrix3 axes{{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};
  const auto inAxes = exact::orthotropic::strainOf(stress);
  const auto e = exact::orthotropic::toMesh(inAxes, axes);
  const double mu = 2.0 / (2 * 1.3), lambda = 2.0 * 0.3 / (1.3 * 0.4),
               trace = e[0][0] + e[1][1] + e[2][2],
               energy = 0.8 * 0.3 * exact::orthotropic::product(stress, inAxes) +
                        0.8 * 0.5 *
                            (2 * mu * exact::orthotropic::product(e, e) + lambda * trace * trace);
  for (const auto& set : cellSets) {
    if (set == "n=1") continue;
    const auto [mesh, bodies] = test::buildBodies(
        laminate + "-mesh_set " + set + " -material_lower_engineering_constants " + lower +
        " -material_lower_orientation 0,1,0,-1,0,0 -material_upper_young 2 "
        "-material_upper_poisson 0.3");
    const auto u = test::nodalField(mesh, [&](const Point& x) {
      Point value{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) value[i] += e[i][j] * x[j];
      return value;
    });
    EXPECT_NEAR(test::form(u, bodies.stiffness, u), energy, 1e-12 * energy) << set;
  }
}

TEST(Sections, FramesAreAxesGivenByHand) {
  const std::string body = "-material_body_density 1 -material_body_engineering_constants " +
                           std::string(exact::orthotropic::constants) + " ";
  const auto expectSame = [&](const std::string& mesh, const std::string& hand,
                              const std::string& frame) {
    const auto one = test::buildBodies(mesh + body + hand),
               two = test::buildBodies(mesh + body + frame + " -material_body_frame f");
    EXPECT_LE(difference(one.bodies.stiffness, two.bodies.stiffness), reordered) << hand;
  };
  for (const auto& set : cellSets) {
    const std::string cube = "-mesh_file meshes/patch_3d.geo -mesh_set " + set + " ";
    expectSame(cube, "-material_body_orientation 1,0.5,0.2,-0.3,1,0.4",
               "-frame_f_x 1,0.5,0.2 -frame_f_xy -0.3,1,0.4");
    expectSame(cube, "-material_body_cylindrical 0.1,0.2,0,1,2,3",
               "-frame_f_axis 1,2,3 -frame_f_origin 0.1,0.2,0");
  }
  const std::string square = "-mesh_file meshes/patch_2d.geo ";
  expectSame(square, "-material_body_orientation 1,0.5,0,-0.3,1,0",
             "-frame_f_x 1,0.5 -frame_f_xy -0.3,1");
  expectSame(square, "-material_body_cylindrical 0.1,0.2,0,0,0,1",
             "-frame_f_axis 0,0,1 -frame_f_origin 0.1,0.2");
}

TEST(Sections, RefusesWrongOptions) {
  const auto expect = [](const std::string& options, const std::vector<std::string>& parts) {
    test::expectMessage(test::errorOf([&] { test::buildBodies(halves("n=1") + options); }), parts);
  };
  const std::string both = law + "-material_body_sections left,right ";
  ASSERT_EQ(test::errorOf([&] { test::buildBodies(halves("n=1") + both); }), "");
  expect(law + "-material_body_sections left", {"option -material_body_sections: cell ",
                                                " of body 'body' is in none of its sections left",
                                                "add a group with this cell, such as right"});
  expect(law + "-material_body_sections left,left", {"-material_body_sections", "'left' twice"});
  expect(law + "-material_body_sections left,top",
         {"option -material_body_sections names group 'top', which is not in the mesh",
          "its groups are: body, boundary, left, right"});
  expect(law + "-material_body_sections left,body",
         {"option -material_body_sections: 'body' is the body itself"});
  expect(
      law + "-material_body_sections left,boundary",
      {"option -material_body_sections: the sections 'left' and 'boundary' have the dimensions 3 "
       "and 2"});
  expect(both + "-material_other_sections left",
         {"option -material_other_sections: 'left' is also in -material_body_sections",
          "a section belongs to one body"});
  expect(law + "-material_body_sections left,other -material_other_sections right",
         {"option -material_body_sections: 'other' has sections itself; name these instead"});
  // One half does not contain the whole cube.
  expect(
      test::material("left", "3", "0.3", "1") + "-material_left_sections body",
      {"option -material_left_sections: cell ", " of section 'body' is not in the group 'left'"});
  // Two sections with the same cells.
  expect(test::material("whole", "3", "0.3", "1") + "-material_whole_sections body,left",
         {"is in the sections 'body' and 'left' of body 'whole'; a cell has one material"});
  // Another body with a cell of a section.
  expect(both + test::material("whole", "3", "0.3", "1"),
         {"option -material_whole_young names group 'whole'"});
  expect("-material_whole_sections left " + test::material("whole", "3", "0.3", "1") +
             test::material("body", "3", "0.3", "1"),
         {"is in the groups 'body' and 'whole', which both have a material"});
  // A section without a law, and an option of the body that none uses.
  expect("-material_body_sections left,right -material_body_density 1",
         {"option -material_left_young (or _engineering_constants",
          "neither the section nor its body 'body' has a law"});
  // Axes without an anisotropic law, and a list that misspells a section.
  expect(both + "-material_body_frame f -frame_f_x 1,1,0",
         {"option -material_body_frame needs -material_body_engineering_constants"});
  expect(test::material("body", "3", "0.3", "1") +
             "-material_body_sections left,rigt -material_right_young 2",
         {"option -material_right_poisson is missing",
          "'right' is not in -material_body_sections left,rigt"});
  expect(both + "-material_left_density 1 -material_right_density 2",
         {"option -material_body_density: no section of 'body' uses it"});
  expect(both + test::material("left", "3", "0.3", "1") +
             "-material_right_orthotropic "
             "3,1,3,1,1,3,1,1,1",
         {"option -material_body_young: no section of 'body' uses it"});
  // Axes without a law that has any, and two kinds of axes.
  expect(both + "-material_left_orientation 1,0,0,0,1,0", {"-material_left_orientation needs"});
  const std::string orthotropic = both + "-material_left_orthotropic 3,1,3,1,1,3,1,1,1 ";
  expect(orthotropic + "-material_left_frame f -material_left_cylindrical 0,0,0,0,0,1",
         {"-material_left_cylindrical and -material_left_frame exclude each other"});
  expect(orthotropic + "-material_left_frame f",
         {"option -material_left_frame f: no frame has this name", "-frame_f_axis"});
  // What belongs to whole bodies.
  for (const std::string option :
       {"-motion_left_speed 1", "-load_left_acceleration 1,0,0", "-load_left_spin 1"})
    expect(both + option, {"option " + option.substr(0, option.find(' ')),
                           "'left' is not a body but a section of 'body'"});
  expect(both + "-material_left_integration reduced",
         {"option -material_left_integration reduced: section 'left' of body 'body' has hex8"});
}

// Rings that turn about their axis keep their materials; halves of a ring do not.
TEST(Sections, ConvectionNeedsSectionsOfRevolution) {
  const std::string ring =
      "-mesh_file meshes/cylinders.geo -mesh_set shared=1,n_theta=32 -motion_convective on ";
  const auto one = test::buildBodies(ring + test::material("inner", "1", "0.3", "2") +
                                     test::material("outer", "2", "0.3", "3") +
                                     "-motion_inner_speed 4 -motion_outer_speed 4"),
             two = test::buildBodies(ring + test::material("inner", "1", "0.3", "2") +
                                     test::material("outer", "2", "0.3", "3") +
                                     "-material_ring_sections inner,outer -motion_ring_speed 4");
  EXPECT_LE(difference(one.bodies.gyroscopic, two.bodies.gyroscopic), rounding);
  EXPECT_LE(difference(one.bodies.rotationStiffness, two.bodies.rotationStiffness), rounding);
  EXPECT_LE(difference(one.bodies.centrifugal, two.bodies.centrifugal), rounding);
  for (const int group : {0, 1}) {
    const auto a = elasticity::materialPart(one.mesh, one.bodies, group),
               b = elasticity::materialPart(two.mesh, two.bodies, group);
    EXPECT_LE(difference(a.gyroscopic, b.gyroscopic), rounding);
    EXPECT_LE(difference(a.rotationStiffness, b.rotationStiffness), rounding);
    EXPECT_LE(difference(a.centrifugal, b.centrifugal), rounding);
  }
  const std::string file = test::writeFile(
      "half_rings.geo",
      "Include \"" + std::filesystem::absolute("meshes/cylinders.geo").string() +
          "\";\nPhysical Surface(\"upper\") = {110, 111};\nPhysical Surface(\"lower\") = {112, "
          "113};\n");
  const std::string halfRings = "-mesh_file " + file + " -mesh_set shared=1,n_theta=32 " +
                                test::material("inner", "1", "0.3", "2") +
                                test::material("outer", "2", "0.3", "3") +
                                "-material_outer_sections upper,lower -motion_outer_speed 4 ";
  EXPECT_EQ(test::errorOf([&] { test::buildBodies(halfRings); }), "");
  test::expectMessage(
      test::errorOf([&] { test::buildBodies(halfRings + "-motion_convective on"); }),
      {"option -motion_convective: section 'upper' of body 'outer' is not a figure of revolution",
       "-motion_convective off"});
}

/// The warning about a rotor in the plane with this law and these axes, without convective terms,
/// and the error with them.
std::pair<std::string, std::string> ofMovingRotor(const std::string& law,
                                                  const std::string& motion) {
  const std::string rotor =
      "-mesh_file meshes/cylinders.geo -mesh_set shared=1,n_theta=32 "
      "-material_rotor_sections inner,outer -material_rotor_density 1 -material_outer_young 1 "
      "-material_outer_poisson 0.3 -material_inner_engineering_constants " +
      law + " " + motion;
  const auto warning = test::warningsOf([&] { test::buildBodies(rotor); });
  return {warning, test::errorOf([&] { test::buildBodies(rotor + " -motion_convective on"); })};
}

TEST(Sections, AxesMustBeThoseThatMatterCarries) {
  const std::string constants = exact::orthotropic::constants, turns = "-motion_rotor_speed 2 ",
                    frame = constants + " -material_inner_frame f ",
                    isotropic = "2,2,0.8,0.3,0.42,0.42," + formatted("%.17g", 2 / 2.6) + ",0.7,0.7";
  for (const auto& [law, motion] : {std::pair{constants, std::string()},
                                    {constants + " -material_inner_cylindrical 0,0,0,0,0,1", turns},
                                    {frame + "-frame_f_axis 0,0,-1 -frame_f_turn 30", turns},
                                    {isotropic, turns + "-motion_rotor_origin 0.3,0.1 "}}) {
    const auto [warning, error] = ofMovingRotor(law, motion);
    EXPECT_FALSE(contains(warning, "carry")) << law;
    EXPECT_FALSE(contains(error, "carry")) << law << error;
  }
  for (const std::string& law : {constants, frame + "-frame_f_axis 0,0,1 -frame_f_origin 0.01,0"}) {
    const auto [warning, error] = ofMovingRotor(law, turns);
    EXPECT_TRUE(contains(warning,
                         "warning: section 'inner' of body 'rotor' moves, and its matter "
                         "would carry the axes of its material"))
        << law << warning;
    EXPECT_TRUE(contains(error, "option -motion_convective: section 'inner' of body 'rotor'"))
        << law << error;
  }
  // Under a translation uniform laws stay, and those of a cylinder do not.
  EXPECT_FALSE(contains(ofMovingRotor(constants, "-motion_rotor_velocity 1,0").first, "carry"));
  EXPECT_TRUE(contains(ofMovingRotor(constants + " -material_inner_cylindrical 0,0,0,0,0,1",
                                     "-motion_rotor_velocity 1,0")
                           .first,
                       "carry"));
}

}  // namespace
}  // namespace squeal
