// SPDX-License-Identifier: BSD-2-Clause
// Reference nodes, couplings, equations and supports in turned axes: rigid motions pass through
// them unchanged, and descriptions of one and the same support give the same frequencies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "eigen/modes/modes.hpp"
#include "model/contact/coupled.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

/// A box of 4 × 2 × 2 cells, 1 × 0.4 × 0.3 m. It is meshed with groups clamped and tip at the ends
/// of the length, and right, left, bottom and top on its sides.
const std::string box = "-mesh_file meshes/beam.geo -mesh_set nx=4,Ly=0.4,Lz=0.3 " +
                        test::material("beam", "2e11", "0.3", "8000");

/// Collective. Returns the lowest frequencies with these options, rad/s.
std::vector<double> frequencies(const std::string& options) {
  test::setOptions(box + "-modes_count 6 " + options);
  const auto model = test::buildModel();
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  return modes::compute(system, modes::Settings::given()).angularFrequency;
}

/// The modes are computed with a relative residual of 1e-5, which leaves errors of its square in
/// the eigenvalues of a symmetric problem.
void expectEqual(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i] / expected[i], 1, 1e-9) << i;
}

/// Collective. Returns the largest difference of A u and u, where u is a rigid motion of the mesh
/// and its reference nodes, rad and m.
double changeOfRigidMotion(const std::string& options) {
  test::setOptions(box + "-constraint_clamped_clamped xyz " + options);
  const auto model = test::buildModel();
  const auto& mesh = *model.mesh;
  const OwnedVec u = test::rigidMotion(mesh, {0.3, -0.2, 0.5}, {0.7, 0.4, -0.9});
  const OwnedVec followed = elasticity::nodalVector(mesh);
  check(MatMult(model.contact.kinematics.matrix, u, followed));
  check(VecAXPY(followed, -1, u));
  PetscReal change = 0;
  check(VecNorm(followed, NORM_INFINITY, &change));
  return change;
}

const std::string eccentric = "-reference_r_position 1.3,0.2,-0.4 -coupling_c_reference r ";

TEST(Couplings, RigidMotionsPassUnchanged) {
  // Round-off of products and sums of numbers of magnitude 1, over at most 30 nodes.
  EXPECT_LT(changeOfRigidMotion(eccentric + "-coupling_c_nodes tip"), 1e-14);
  EXPECT_LT(changeOfRigidMotion(eccentric + "-coupling_c_nodes tip,left "
                                            "-coupling_c_kind distributed "
                                            "-coupling_c_weights 1,2.7"),
            1e-13);
  const std::string chain =
      eccentric +
      "-coupling_c_nodes tip -coupling_c_kind distributed -reference_s_position 2,1,1 "
      "-coupling_d_reference s -coupling_d_nodes q -reference_q_centre_of top "
      "-coupling_e_reference q -coupling_e_nodes top,r ";
  // r follows the tip and would follow q, too.
  test::setOptions(box + "-constraint_clamped_clamped xyz " + chain);
  EXPECT_NE(test::errorOf([] { test::buildModel(); }).find("follows coupling"), std::string::npos);
  EXPECT_LT(changeOfRigidMotion("-reference_r_position 1.3,0.2,-0.4 -coupling_c_reference r "
                                "-coupling_c_nodes tip -reference_s_position 2,1,1 "
                                "-coupling_d_reference s -coupling_d_nodes r,t "
                                "-reference_t_position 0.5,1,1"),
            1e-14);
}

TEST(Couplings, HeldReferenceNodeIsAClamp) {
  const auto clamped = frequencies("-constraint_clamped_clamped xyz");
  const std::string held = "-constraint_r_clamped xyz -constraint_r_clamped_rotation xyz ";
  expectEqual(frequencies("-reference_r_position -0.1,0.3,0.2 -coupling_c_reference r "
                          "-coupling_c_nodes clamped " +
                          held),
              clamped);
  // Supports of coupled nodes act on the reference node.
  expectEqual(frequencies("-reference_r_position -0.1,0.3,0.2 -coupling_c_reference r "
                          "-coupling_c_nodes clamped -constraint_clamped_clamped xyz"),
              clamped);
  // A chain of two reference nodes, and equations in place of supports.
  expectEqual(
      frequencies("-reference_q_centre_of clamped -coupling_c_reference q "
                  "-coupling_c_nodes clamped -reference_r_position 3,2,1 -coupling_d_reference r "
                  "-coupling_d_nodes q -constraint_r_clamped_rotation xyz "
                  "-equation_a 'r:x + 2*r:y = 0' -equation_b 'r:x - r:y = 0' "
                  "-equation_z '1e6*r:z - 3*r:rx = 0'"),
      clamped);
  expectEqual(frequencies("-constraint_clamped_clamped xyz -constraint_clamped_frame f "
                          "-frame_f_axis 1,0.2,0.1 -frame_f_origin 0,0.7,0.1"),
              clamped);
}

TEST(Couplings, SlantedSupportIsAnEquation) {
  const std::string end =
      "-reference_r_position 0,0,0 -coupling_c_reference r -coupling_c_nodes clamped "
      "-constraint_r_clamped_rotation xyz -constraint_r_clamped z ";
  const auto byEquations = frequencies(end +
                                       "-equation_a '3*r:x + 4*r:y = 0' "
                                       "-ground_tip_stiffness 1e8,1e8,1e8");
  const auto byFrame = frequencies(
      "-reference_r_position 0,0,0 -coupling_c_reference r "
      "-coupling_c_nodes clamped -constraint_r_clamped_rotation xyz "
      "-constraint_r_clamped xz -constraint_r_frame f -frame_f_x 3,4,0 "
      "-frame_f_xy 0,1,0 -ground_tip_stiffness 1e8,1e8,1e8");
  expectEqual(byFrame, byEquations);
  // The same support on the coupled nodes.
  expectEqual(frequencies("-reference_r_position 0,0,0 -coupling_c_reference r "
                          "-coupling_c_nodes clamped -constraint_r_clamped_rotation xyz "
                          "-constraint_clamped_clamped xz -constraint_clamped_frame f "
                          "-frame_f_x 3,4,0 -frame_f_xy 0,1,0 "
                          "-ground_tip_stiffness 1e8,1e8,1e8"),
              byEquations);
  // Coupled only along the slanted direction, and free along the plane: as with the same plane
  // held at the nodes themselves.
  const std::string grounded =
      "-ground_tip_stiffness 1e8,2e8,3e8 -frame_f_x 3,4,0 -frame_f_xy 0,1,0 ";
  expectEqual(frequencies(grounded + "-reference_r_position 0.1,0.2,0.3 -coupling_c_reference r "
                                     "-coupling_c_nodes clamped -coupling_c_components x "
                                     "-coupling_c_frame f -constraint_r_clamped xyz "
                                     "-constraint_r_clamped_rotation xyz"),
              frequencies(grounded + "-constraint_clamped_clamped x -constraint_clamped_frame f"));
}

TEST(Couplings, DistributedReferenceNodeCanBeHeld) {
  // The nodes of the group keep their mean place and rotation, less than a clamp: the lowest
  // frequency falls, by a few hundredths as the end is short.
  const auto clamped = frequencies("-constraint_clamped_clamped xyz");
  const std::string held =
      "-coupling_c_reference r -coupling_c_nodes clamped -coupling_c_kind distributed "
      "-constraint_r_clamped xyz -constraint_r_clamped_rotation xyz ";
  const auto atCentre = frequencies(held + "-reference_r_centre_of clamped");
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(atCentre[i], clamped[i]) << i;
  EXPECT_GT(atCentre[0], 0.9 * clamped[0]);
  // Its place is immaterial if it is held whole.
  expectEqual(frequencies(held + "-reference_r_position -2,1,3"), atCentre);
  // Equal weights may have any value.
  expectEqual(frequencies(held + "-reference_r_position -2,1,3 -coupling_c_weights 17"), atCentre);
}

/// Collective. Returns the message of the model with these options.
std::string messageOf(const std::string& options) {
  test::setOptions(box + "-constraint_clamped_clamped xyz " + options);
  return test::errorOf([] { test::buildModel(); });
}

TEST(Couplings, FaultsAreNamed) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"-coupling_c_reference r -coupling_c_nodes tip",
       "option -coupling_c_reference r: no reference node has this name; make it with "
       "-reference_r_position or -reference_r_centre_of"},
      {"-coupling_c_nodes tip", "option -coupling_c_nodes needs -coupling_c_reference"},
      {"-coupling_c_reference r -reference_r_position 1,0,0",
       "option -coupling_c_reference needs -coupling_c_nodes"},
      {eccentric + "-coupling_c_nodes nothing",
       "option -coupling_c_nodes names group 'nothing', which is not in the mesh"},
      {eccentric + "-coupling_c_nodes tip,tip", "option -coupling_c_nodes: 'tip' is there twice"},
      {eccentric + "-coupling_c_nodes r",
       "option -coupling_c_nodes: 'r' is the reference node of this coupling"},
      {eccentric + "-coupling_c_nodes tip -coupling_c_weights 2",
       "option -coupling_c_weights needs -coupling_c_kind distributed"},
      {eccentric + "-coupling_c_nodes tip -coupling_c_kind distributed -coupling_c_weights 2,3",
       "option -coupling_c_weights: 2 weights for the 1 groups of -coupling_c_nodes"},
      {eccentric + "-coupling_c_nodes tip -coupling_c_kind distributed -coupling_c_frame f",
       "option -coupling_c_frame needs -coupling_c_kind rigid"},
      {eccentric + "-coupling_c_nodes tip -coupling_c_components xw",
       "option -coupling_c_components xw: must be some of the letters xyz"},
      {eccentric + "-coupling_c_nodes tip -coupling_c_frame f",
       "option -coupling_c_frame f: no frame has this name; -frame_f_x or -frame_f_axis "
       "makes one"},
      {eccentric + "-coupling_c_nodes tip -reference_r_centre_of tip",
       "options -reference_r_position and -reference_r_centre_of: give the position once"},
      {"-reference_tip_position 1,0,0 -coupling_c_reference tip -coupling_c_nodes top",
       "option -reference_tip_position: a group of the mesh has the name 'tip' already"},
      {eccentric + "-coupling_c_nodes tip -coupling_d_reference r -coupling_d_nodes top",
       "follows coupling 'c' already; a node can follow one coupling"},
      {"-reference_r_position 1,0,0", "body 'reference node r' can move rigidly"},
      {"-reference_r_position 1,0,0 -reference_s_position 2,0,0 -coupling_c_reference r "
       "-coupling_c_nodes s -coupling_c_kind distributed",
       "option -coupling_c_nodes: its 1 nodes lie on a line or in a point"},
      {"-reference_r_position 1,0,0 -reference_s_position 2,0,0 -coupling_c_reference r "
       "-coupling_c_nodes s -coupling_d_reference s -coupling_d_nodes r",
       "depend on each other in a circle: coupling 'c', coupling 'd'"},
      {"-frame_f_x 1,0,0 -frame_f_xy 2,0,0 -constraint_tip_clamped x -constraint_tip_frame f",
       "option -frame_f_xy: is parallel to -frame_f_x"},
      {"-frame_f_x 0,0,0 -constraint_tip_clamped x -constraint_tip_frame f",
       "option -frame_f_x: the direction of an axis must not be zero"},
      {"-frame_f_x 1,0,0 -frame_f_axis 0,0,1", "frame 'f': give either -frame_f_x"},
      {"-frame_f_axis 1,0,0 -constraint_tip_clamped x -constraint_tip_frame f",
       "option -constraint_tip_frame f: the point (1, "},
      {"-constraint_tip_clamped_rotation x", "'tip' is not a reference node"},
      {"-equation_a 'tip:x = 0'", "group 'tip' has 9 nodes; a term needs a group of one node"},
      {eccentric + "-coupling_c_nodes tip -equation_a 'r:x 0'", "must have one equals sign"},
      {eccentric + "-coupling_c_nodes tip -equation_a 'r:z-2*r:y = 0'",
       "'r:z-2' is not a number; a blank before + and - separates terms"},
      {eccentric + "-coupling_c_nodes tip -equation_a 'r:z-r:y = 0'",
       "'r:z-r:y' has two components; a blank before + and - separates terms"},
      {eccentric + "-coupling_c_nodes tip,q",
       "names group 'q', which is not in the mesh; its groups are: beam, bottom, clamped, left, "
       "right, tip, top; the reference nodes are: r"},
      {eccentric + "-coupling_c_nodes tip -equation_a 'r:w = 0'",
       "the component of 'r:w' must be x, y, z, rx, ry or rz"},
      {eccentric + "-coupling_c_nodes tip -equation_a 'r:x = 1' -equation_b '2*r:x = 3'",
       "option -equation_b '2*r:x = 3': it contradicts other equations and supports"},
  };
  for (const auto& [options, message] : faults)
    EXPECT_NE(messageOf(options).find(message), std::string::npos)
        << options << "\n  " << messageOf(options);
}

TEST(Couplings, NothingToSolveForIsNamed) {
  for (const auto& [options, holding] : std::vector<std::pair<std::string, std::string>>{
           {"-reference_r_position 0,0,0 -coupling_c_reference r -coupling_c_nodes beam "
            "-constraint_r_clamped xyz -constraint_r_clamped_rotation xyz ",
            "constraint 'r', coupling 'c'"},
           {"-constraint_beam_clamped xyz ", "constraint 'beam'"}}) {
    test::setOptions(box + options);
    const auto model = test::buildModel();
    EXPECT_EQ(test::errorOf([&] { contact::CoupledSystem(model.bodies, model.contact, {}); }),
              formatted("no displacement is unknown: all %" PetscInt_FMT
                        " nodes are held, or follow nodes that are (",
                        model.mesh->totalNodes) +
                  holding + "); free some of them");
  }
}

TEST(Couplings, NodesWithPeriodicImagesAreRefused) {
  test::setCase("layer",
                "-reference_r_position 0,0,0 -coupling_c_reference r -coupling_c_nodes right");
  const std::string message = test::errorOf([] { test::buildModel(); });
  EXPECT_NE(message.find("of group 'right' has a periodic image"), std::string::npos) << message;
}

}  // namespace
}  // namespace squeal
