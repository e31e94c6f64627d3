// SPDX-License-Identifier: BSD-2-Clause
// The matrices of an active set as parts of those with all contact open.
#include <gtest/gtest.h>

#include "model/contact/coupled.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/sparse.hpp"
#include "support/model/model.hpp"

namespace squeal::test {
namespace {

void expectSame(const contact::Projection& part, const contact::Projection& direct,
                const std::string& name) {
  ASSERT_EQ(bool(part), bool(direct)) << name;
  if (!part) return;
  for (const auto& [one, other] : {std::pair{part.matrix.get(), direct.matrix.get()},
                                   std::pair{part.reaction.get(), direct.reaction.get()}}) {
    const auto a = denseCopy(one), b = denseCopy(other);
    ASSERT_EQ(a.rows(), b.rows()) << name;
    ASSERT_EQ(a.columns(), b.columns()) << name;
    // Each entry is the same sum, to the order of summation between ranks.
    EXPECT_LE(largestDifference(a, b), 1e-15 * largestEntry(b)) << name;
  }
  PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(part.matrix, &known, &symmetric));
  PetscBool directKnown = PETSC_FALSE, directSymmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(direct.matrix, &directKnown, &directSymmetric));
  EXPECT_EQ(known && symmetric, directKnown && directSymmetric) << name;
}

// Two blocks whose meshes do not match slide and stick on a third one. Every third contact node is
// open, every fourth is released, in the order of each rank; also all closed and all open.
TEST(OpenProjections, ContainThoseOfEverySet) {
  const std::string file = writeFile("three_blocks.geo", R"(SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -0.5, 0, 0, 0.5, 2.2};
Box(2) = {0.1, 0.1, 0, 0.8, 0.8, 0.4};
Box(3) = {1.1, 0.1, 0, 0.8, 0.8, 0.4};
MeshSize{:} = 0.4;
Mesh.ElementOrder = 1;
Physical Volume("disc") = {1};
Physical Volume("pad") = {2};
Physical Volume("holder") = {3};
e = 1e-6;
faces() = Boundary{ Volume{1}; };
Physical Surface("disc_face") = {faces[1]};
Physical Surface("disc_low") = {faces[2]};
low() = Surface In BoundingBox{0.1 - e, 0.1 - e, -e, 0.9 + e, 0.9 + e, e};
Physical Surface("pad_low") = {low()};
under() = Surface In BoundingBox{1.1 - e, 0.1 - e, -e, 1.9 + e, 0.9 + e, e};
Physical Surface("holder_low") = {under()};
Physical Surface("top") = Surface In BoundingBox{-1, -1, 0.4 - e, 3, 3, 0.4 + e};
)");
  setOptions("-mesh_file " + file + material("disc", "2e9", "0.3", "1000") +
             material("pad", "1e9", "0.2", "1000") + material("holder", "1e9", "0.2", "1000") +
             "-material_pad_rayleigh_stiffness 1e-6 -motion_disc_speed 3 -motion_disc_axis "
             "0,0,1 -motion_convective on "
             "-constraint_disc_low_clamped xyz -constraint_top_clamped xyz "
             "-contact_slide_pad pad_low -contact_slide_disc disc_face "
             "-contact_stick_pad holder_low -contact_stick_disc disc_face "
             "-contact_stick_role sticking");
  const auto model = buildModel();
  const contact::OpenProjections open(model.bodies, model.contact);
  const std::size_t nodes = model.contact.interfaces.nodes.size();
  contact::ActiveSet mixed = contact::ActiveSet::bonded(nodes), free = mixed;
  mixed.released.assign(nodes, 0);
  for (std::size_t i = 0; i < nodes; ++i) {
    mixed.closed[i] = i % 3 != 0;
    mixed.released[i] = i % 4 == 0;
    free.closed[i] = 0;
  }
  for (const auto& set : {contact::ActiveSet::bonded(nodes), mixed, free}) {
    const contact::CoupledSystem part(open, model.contact, set),
        direct(model.bodies, model.contact, set);
    EXPECT_EQ(part.size(), direct.size());
    EXPECT_EQ(part.openNodes(), direct.openNodes());
    const auto &a = part.projections(), &b = direct.projections();
    expectSame(a.stiffness, b.stiffness, "K");
    expectSame(a.mass, b.mass, "M");
    expectSame(a.damping, b.damping, "C");
    expectSame(a.gyroscopic, b.gyroscopic, "G");
    expectSame(a.rotationStiffness, b.rotationStiffness, "K^R");
  }
}

}  // namespace
}  // namespace squeal::test
