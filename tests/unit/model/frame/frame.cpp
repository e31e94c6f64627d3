// SPDX-License-Identifier: BSD-2-Clause
// Local axes that are turned about one of them, and frames that nothing uses.
#include "model/frame/frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "exact/orthotropic.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/sparse.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using mesh::Point;

frame::Frame frameOf(const std::string& options, int dimension = 3) {
  test::setOptions(options);
  mesh::Mesh mesh;
  mesh.dimension = dimension;
  return frame::named(frame::framesGiven(), "f", "-some_frame", mesh);
}

void expectAxes(const mesh::Matrix3& found, const mesh::Matrix3& expected) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(found[i][j], expected[i][j], 1e-15) << i << j;
}

TEST(Frame, IsTurnedAboutOneOfItsAxes) {
  const double c = std::cos(M_PI / 6), s = 0.5;
  const std::string square = "-frame_f_x 0,1,0 -frame_f_xy -1,0,0 -frame_f_turn 30 ";
  // x = (0, 1, 0), y = (−1, 0, 0), z = (0, 0, 1) before the turn
  expectAxes(frameOf(square).axesAt({}), {{{-s, c, 0}, {-c, -s, 0}, {0, 0, 1}}});
  expectAxes(frameOf(square + "-frame_f_turn_about x").axesAt({}),
             {{{0, 1, 0}, {-c, 0, s}, {s, 0, c}}});
  expectAxes(frameOf(square + "-frame_f_turn_about y").axesAt({}),
             {{{0, c, -s}, {-1, 0, 0}, {0, s, c}}});
  // The normal of a cone that widens along its axis: radial outwards and against the axis.
  expectAxes(
      frameOf("-frame_f_axis 0,0,1 -frame_f_turn 30 -frame_f_turn_about y").axesAt({0, 2, 5}),
      {{{0, c, -s}, {-1, 0, 0}, {0, s, c}}});
  expectAxes(frameOf("-frame_f_x 1,0 -frame_f_turn 30", 2).axesAt({}),
             {{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}});
}

/// The stiffness of the cube of distorted cells with an orthotropic law in a frame.
OwnedMat stiffnessIn(const std::string& frame, const std::string& constants) {
  return std::move(
      test::buildBodies("-mesh_file meshes/patch_3d.geo -material_body_density 1 "
                        "-material_body_frame f -material_body_engineering_constants " +
                        constants + " " + frame)
          .bodies.stiffness);
}

double difference(Mat one, Mat other) {
  const auto a = test::denseCopy(one), b = test::denseCopy(other);
  return test::largestDifference(a, b) / test::largestEntry(a);
}

TEST(Frame, TurnsTheAxesOfMaterials) {
  const std::string constants = exact::orthotropic::constants, x = "-frame_f_turn_about x ";
  // By a right angle about x: axis 2 along the old 3, and 3 against the old 2.
  const std::string exchanged = "3,0.8,1.3,0.42,0.35," + formatted("%.17g", 0.27 * 0.8 / 1.3) +
                                ",0.7,0.9,0.5",
                    cylinder = "-frame_f_axis 1,2,3 -frame_f_origin 0.1,0.2,0 ";
  EXPECT_LT(difference(stiffnessIn(cylinder + x + "-frame_f_turn 90", constants),
                       stiffnessIn(cylinder, exchanged)),
            1e-14);
  const std::string square = "-frame_f_x 1,0.5,0.2 -frame_f_xy -0.3,1,0.4 ";
  EXPECT_LT(difference(stiffnessIn(square + x + "-frame_f_turn 90", constants),
                       stiffnessIn(square, exchanged)),
            1e-14);
  // Far from its axis a cylindrical frame is rectangular, except for 1/1e7 of the size.
  EXPECT_LT(difference(stiffnessIn(
                           "-frame_f_axis 0,0,1 -frame_f_origin -1e7,0,0 " + x + "-frame_f_turn 33",
                           constants),
                       stiffnessIn("-frame_f_x 1,0,0 " + x + "-frame_f_turn 33", constants)),
            1e-6);
}

// The axes that files show are those of the law.
TEST(Frame, AxesOfMaterialsAreThoseOfTheirLaws) {
  const auto law = material::orthotropic({3, 1.3, 0.8, 0.35, 0.42, 0.27, 0.9, 0.7, 0.5});
  const Point x{0.3, -0.7, 0.4};
  for (const std::string axes :
       {"", "-material_body_orientation 1,0.5,0.2,-0.3,1,0.4",
        "-material_body_cylindrical 0.1,0.2,0,1,2,3",
        "-material_body_frame f -frame_f_x 1,0.5,0.2 -frame_f_turn 20 -frame_f_turn_about x",
        "-material_body_frame f -frame_f_axis 1,0.5,0.2 -frame_f_turn 20 -frame_f_turn_about x"}) {
    const auto built = test::buildBodies(
        "-mesh_file meshes/patch_3d.geo -material_body_density 1 "
        "-material_body_engineering_constants " +
        std::string(exact::orthotropic::constants) + " " + axes);
    const auto& material = built.bodies.materials.at(0);
    material::Hooke storage;
    const auto &found = material.law.at(x, storage),
               expected = material::rotated(law, material.axes(x));
    for (std::size_t i = 0; i < 36; ++i)
      EXPECT_NEAR(found.matrix[i], expected.matrix[i], 1e-14) << axes << i;
  }
}

TEST(Frame, RefusesWrongTurns) {
  const auto expect = [](const std::string& options, const std::string& part, int dimension) {
    const auto message = test::errorOf([&] { frameOf(options, dimension); });
    EXPECT_TRUE(test::contains(message, part)) << options << ": " << message;
  };
  expect("-frame_f_turn 30", "frame 'f': give either -frame_f_x", 3);
  expect("-frame_f_x 1,0,0 -frame_f_turn_about x", "option -frame_f_turn_about needs -frame_f_turn",
         3);
  expect("-frame_f_axis 0,0,1 -frame_f_turn 30 -frame_f_turn_about x",
         "option -frame_f_turn_about: in plane problems must be z", 2);
}

// A cell whose centre lies on the axis of an orthotropic law has no radial direction, also if
// round-off gives it one; a law that is symmetric about the axis needs none.
TEST(Frame, AxisThroughACellIsRefused) {
  const std::string beam =
                        "-mesh_file meshes/beam.geo -mesh_set nx=2,ny=1,nz=1,Lx=2,Ly=1,Lz=1 "
                        "-material_beam_density 1 -constraint_clamped_clamped xyz "
                        "-material_beam_engineering_constants ",
                    orthotropic = exact::orthotropic::constants,
                    symmetric = "1,2,2,0.1,0.1,0.25,0.5,0.5,0.8";  // about axis 1
  const auto message = [&](const std::string& options) {
    return test::errorOf([&] {
      test::setOptions(beam + options);
      test::buildModel();
    });
  };
  for (const std::string axes :
       {"-material_beam_cylindrical 0,0,1e-16,1,0,0",
        "-material_beam_frame f -frame_f_axis 1,0,0 -frame_f_origin 0,0,1e-11"})
    EXPECT_TRUE(test::contains(message(orthotropic + " " + axes),
                               "body 'beam': the axis of the cylindrical axes of its material "
                               "passes through the centre of the cell at"))
        << message(orthotropic + " " + axes);
  // A turn by a right angle about y makes axis 1 of the law that of the cylinder.
  EXPECT_EQ(message(symmetric + " -material_beam_frame f -frame_f_axis 1,0,0 -frame_f_origin "
                                "0,0,0 -frame_f_turn 90 -frame_f_turn_about y"),
            "");
  EXPECT_EQ(message(orthotropic + " -material_beam_cylindrical 0,0,0.001,1,0,0"), "");
}

TEST(Frame, OfNoUseIsNamed) {
  const std::string box = "-mesh_file meshes/beam.geo -mesh_set nx=2,ny=1,nz=1 " +
                          test::material("beam", "1", "0.3", "1") +
                          "-constraint_clamped_clamped x -constraint_clamped_frame f "
                          "-frame_f_x 1,1,0 ";
  const auto warnings = [](const std::string& options) {
    return test::warningsOf([&] {
      test::setOptions(options);
      analysis::buildModel(PETSC_COMM_WORLD, analysis::ModelSettings::given());
    });
  };
  const std::string held = box + "-ground_tip_stiffness 1,1,1 ";
  EXPECT_FALSE(test::contains(warnings(held), "frame"));
  EXPECT_TRUE(test::contains(warnings(held + "-frame_g_x 1,1,0"),
                             "no other option refers to the frame 'g'"));
}

}  // namespace
}  // namespace squeal
