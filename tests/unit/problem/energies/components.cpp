// SPDX-License-Identifier: BSD-2-Clause
// The forms of the components of a brake, against the matrices of each component.
#include <gtest/gtest.h>

#include <cmath>

#include "model/elasticity/attached_parts.hpp"
#include "problem/energies/components.hpp"
#include "support/algebra/sparse.hpp"
#include "support/model/model.hpp"

namespace squeal::test {
namespace {

OwnedVec times(Mat x, Vec u) {
  OwnedVec y;
  check(VecDuplicate(u, y.out()));
  check(MatMult(x, u, y));
  return y;
}

double form(Mat x, Vec u) {
  PetscScalar value = 0;
  if (x) check(VecDot(times(x, u), u, &value));
  return value;
}

/// A coarse disc brake whose bodies share nodes (disc and hat, back plate and lining), with a soft
/// layer, springs to the ground in a turned frame, a bushing, a spring and a mass.
Model brake() {
  setCase("disc_brake",
          "-mesh_set n_pad_theta=4,n_free_theta=8,n_mount=2,n_plate=1,n_inside=1,n_pad_r=2,n_hat=2,"
          "n_h_ring=1 -contact_pad_stiffness 1e13 -material_lining_damping_stiffness 1e-6 "
          "-material_disc_damping_mass 3 -material_hat_damping_stiffness 2e-6 "
          "-ground_pressed_stiffness 1e7,2e7,3e6 -ground_pressed_damping 20,10,5 "
          "-ground_pressed_frame turned -frame_turned_x 0,0.6,0.8 -frame_turned_xy 1,0,0 "
          "-reference_r_position 0.1,0,0.05 -coupling_r_reference r -coupling_r_nodes pressed "
          "-coupling_r_kind distributed "
          "-bushing_b_from r -bushing_b_stiffness 1e8,2e8,3e8,1e5,2e5,1e5 "
          "-bushing_b_damping 10,20,30,1,1,1 -mass_r_total 0.3 -mass_r_inertia "
          "1e-4,2e-4,1e-4,0,0,0");
  return buildModel();
}

// Where a body has its nodes for itself, the rows of the matrices of all bodies are its own; on
// shared nodes they are not. The relative tolerance is that of sums of some 10^5 products.
TEST(Components, HaveTheFormsOfTheirMatrices) {
  const Model model = brake();
  const auto& [mesh, bodies, contact] = model;
  const energies::Components components(*mesh, bodies, contact, energies::nodesOfBodies(*mesh));
  OwnedVec u = elasticity::nodalVector(*mesh);
  PetscInt first = 0;
  {
    const WriteArray values(u);
    check(VecGetOwnershipRange(u, &first, nullptr));
    for (PetscInt i = 0; i < values.size(); ++i) values[i] = 1e-6 * std::sin(1.7 * (first + i));
  }
  const OwnedVec elastic = times(bodies.stiffness, u), inertia = times(bodies.mass, u),
                 damped = times(bodies.damping, u);
  std::vector<energies::Forms> found;
  {
    const ReadArray x(u), k(elastic), m(inertia), c(damped);
    found = components.forms({.u = x, .mass = m, .stiffness = k, .damping = c});
  }
  const double stiffness = form(bodies.stiffness, u), mass = form(bodies.mass, u),
               damping = form(bodies.damping, u);
  std::map<std::pair<std::string, std::string>, energies::Forms> wanted;
  for (int group = 0; group < std::ssize(mesh->materialGroups); ++group) {
    const auto part = elasticity::materialPart(*mesh, bodies, group);
    const double k = form(part.stiffness, u), m = form(part.mass, u);
    wanted[{"body", mesh->materialGroups[group].name}] = {
        k, m, part.massDamping * m + part.stiffnessDamping * k};
  }
  for (const auto& part : elasticity::attachedParts(*mesh, bodies)) {
    const bool isMass = part.parameter.starts_with("mass_");
    auto& sum = wanted[{isMass ? "mass" : "bushing", isMass ? "r" : "b"}];
    sum.stiffness += form(part.stiffness, u), sum.mass += form(part.mass, u);
    sum.damping += form(part.damping, u);
  }
  wanted[{"ground", "pressed"}] = {form(bodies.springs, u), 0, 0};
  wanted[{"interface", "pad"}] = {form(bodies.layerStiffness, u), 0, 0};
  ASSERT_EQ(found.size(), wanted.size());
  energies::Forms sum;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::string &kind = components.list()[i].kind, &name = components.list()[i].name;
    const auto& one = wanted.at({kind, name});
    EXPECT_NEAR(found[i].stiffness, one.stiffness, 1e-11 * stiffness) << kind << " " << name;
    EXPECT_NEAR(found[i].mass, one.mass, 1e-11 * mass) << kind << " " << name;
    if (kind != "ground") {
      EXPECT_NEAR(found[i].damping, one.damping, 1e-11 * damping) << kind << " " << name;
    }
    sum.stiffness += found[i].stiffness, sum.mass += found[i].mass, sum.damping += found[i].damping;
  }
  EXPECT_NEAR(sum.stiffness, stiffness, 1e-11 * stiffness);
  EXPECT_NEAR(sum.mass, mass, 1e-11 * mass);
  EXPECT_NEAR(sum.damping, damping, 1e-11 * damping);  // with the dashpots to the ground
}

}  // namespace
}  // namespace squeal::test
