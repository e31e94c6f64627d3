// SPDX-License-Identifier: BSD-2-Clause
// Soft layers on contact faces, contact that does not separate, and the errors of their options.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "base/petsc/arrays.hpp"
#include "base/system/text.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using test::contains;

constexpr double normal = 3.0, tangential = 0.7, depth = 0.5, length = 3;

/// The energy of the layers if all nodes on the faces below them move by `shift` and the layer
/// nodes do not.
double energy(const test::Model& model, const mesh::Point& shift) {
  const OwnedVec u = elasticity::nodalVector(*model.mesh),
                 force = elasticity::nodalVector(*model.mesh);
  {
    const WriteArray values(u);
    for (const auto& [node, layer] : model.mesh->layers)
      for (int d = 0; d < 3; ++d) values[3 * node + d] = shift[d];
  }
  check(MatMult(model.bodies.layerStiffness, u, force));
  PetscScalar twice = 0;
  check(VecDot(u, force, &twice));
  return twice / 2;
}

test::Model slabs(const std::string& options) {
  test::setCase("two_layers_antiplane",
                formatted("-contact_interface_stiffness %g -mesh_set depth=%g,ny_disc=2,ny_pad=2,",
                          normal, depth) +
                    options);
  return test::buildModel();
}

// ½ k A d² over the whole face, images of periodic nodes included: shape functions add up to one,
// and so do those of the gap basis. Cells with faces of 3, 4, 6, 8 and 9 nodes, on a number of
// ranks that divides the face.
TEST(SoftLayers, ResistACompressionOfTheWholeFace) {
  const double area = length * depth;
  for (const std::string cells :
       {"nx=4,nz=2", "nx=4,nz=2,shape=0", "nx=4,nz=2,order=2", "nx=4,nz=2,order=2,serendipity=1",
        "nx=4,nz=1,order=2,shape=0", "nx=4,nx_pad=6,nz=1,nz_pad=2",
        "nx=4,nx_pad=6,nz=1,nz_pad=2,order=2"}) {
    const auto model = slabs(cells);
    ASSERT_TRUE(model.bodies.layerStiffness) << cells;
    EXPECT_NEAR(energy(model, {0, 2, 0}) / (2 * normal * area), 1, 1e-12) << cells;
    EXPECT_NEAR(energy(model, {1, 0, 1}), 0, 1e-12 * normal * area) << cells;
  }
}

// The layer of a sticking interface is a spring along the face as well.
TEST(SoftLayers, OfStickingInterfacesResistAShift) {
  const auto model =
      slabs(formatted("nx=4,nz=2 -contact_interface_role sticking "
                      "-contact_interface_stiffness_tangential %g",
                      tangential));
  const double area = length * depth;
  EXPECT_NEAR(energy(model, {0, 2, 0}) / (2 * normal * area), 1, 1e-12);
  EXPECT_NEAR(energy(model, {2, 0, 0}) / (2 * tangential * area), 1, 1e-12);
  EXPECT_NEAR(energy(model, {0, 0, 2}) / (2 * tangential * area), 1, 1e-12);
}

// A motion x with closed gaps moves each layer node as its contact demands: with the face along it,
// and with the other side across it.
TEST(SoftLayers, MoveWithTheFaceAlongItAndWithTheOtherSideAcrossIt) {
  const auto model = slabs("nx=4,nz=2");
  const auto& contact = model.contact;
  const auto all =
      contact.transformation(contact::ActiveSet::bonded(contact.interfaces.nodes.size()));
  const OwnedVec x = rightVector(all.trial), u = elasticity::nodalVector(*model.mesh),
                 jump = elasticity::nodalVector(*model.mesh);
  {
    const WriteArray values(x);
    PetscInt first = 0;
    check(VecGetOwnershipRange(x, &first, nullptr));
    for (PetscInt i = 0; i < values.size(); ++i) values[i] = std::sin(double(first + i));
  }
  check(MatMult(all.trial, x, u));
  check(MatMult(contact.sliding.jump, u, jump));
  const ReadArray values(u), jumps(jump);
  for (const auto& node : contact.interfaces.nodes) {
    ASSERT_TRUE(node.hasLayer());
    for (const int d : {0, 2})
      EXPECT_NEAR(values[3 * node.node + d], values[3 * node.surfaceNode + d], 1e-14);
    EXPECT_NEAR(jumps[3 * node.node + 1], 0, 1e-14);
  }
  EXPECT_EQ(contact.interfaces.totalNodes, 4 * 2);  // images left out
}

/// The message of the error of the case with these options; empty if there is none.
std::string message(const std::string& options) {
  test::setCase("two_layers", "-mesh_set nx=4,ny_disc=2,ny_pad=2 " + options);
  return test::errorOf([] { test::buildModel(); });
}

TEST(SoftLayers, RejectContradictions) {
  const std::string stiffness = "-contact_interface_stiffness ",
                    separation = "-contact_interface_separation off ",
                    role = "-contact_interface_role ";
  EXPECT_EQ(message(stiffness + "1 " + separation), "");
  EXPECT_TRUE(contains(message(stiffness + "-1"), "-contact_interface_stiffness"));
  EXPECT_TRUE(contains(message(stiffness + "1 " + role + "tied"), "model the layer as a body"));
  EXPECT_TRUE(contains(message(stiffness + "1 " + role + "sticking"),
                       "needs -contact_interface_stiffness_tangential"));
  EXPECT_TRUE(contains(message(stiffness + "1 -contact_interface_stiffness_tangential 1"),
                       "needs -contact_interface_role sticking"));
  EXPECT_TRUE(contains(message(separation + role + "tied"), "has no effect on a tied interface"));
  for (const std::string gap : {"measured", "0.1"})
    EXPECT_TRUE(contains(message(separation + "-contact_interface_gap " + gap),
                         "would pull an open gap shut"));
  EXPECT_EQ(message(separation + "-contact_interface_gap -0.1"), "");
  EXPECT_TRUE(contains(message("-contact_other_stiffness 1"), "-contact_other_pad"));
}

// A held node cannot stick to the other side. Both remedies of the message work.
TEST(SoftLayers, LetSupportsHoldNodesThatStick) {
  const std::string held = "-contact_interface_role sticking -constraint_pad_face_clamped x ",
                    found = message(held);
  for (const char* words :
       {"option -constraint_pad_face_clamped holds component x of a node of interface 'interface' "
        "at (",
        "), which sticks to the other side; let the other side bear the gaps by "
        "-contact_interface_slave disc, or give a soft layer, -contact_interface_stiffness"})
    EXPECT_TRUE(contains(found, words)) << found;
  EXPECT_EQ(message(held + "-contact_interface_slave disc"), "");
  EXPECT_EQ(message(held + "-contact_interface_stiffness 1 -contact_interface_stiffness_tangential "
                           "1"),
            "");
}

}  // namespace
}  // namespace squeal
