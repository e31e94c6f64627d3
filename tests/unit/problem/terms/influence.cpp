// SPDX-License-Identifier: BSD-2-Clause
// Derivatives of the eigenvalues of frictionless contact: by Rayleigh's quotient they are shares of
// the energies of the bodies.
#include "problem/terms/influence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "algebra/linalg/columns.hpp"
#include "eigen/modes/modes.hpp"
#include "model/contact/coupled.hpp"
#include "problem/terms/terms.hpp"
#include "support/steady/condensed_contact.hpp"

namespace squeal::test {
namespace {

/// Collective. Returns uᵀ A u.
double quadraticForm(Mat a, Vec u) {
  OwnedVec product;
  PetscScalar value = 0;
  check(VecDuplicate(u, product.out()));
  check(MatMult(a, u, product));
  check(VecDot(u, product, &value));
  return value;
}

/// Collective. Returns the first free modes as eigenvalues i ω with their shapes.
pencil::ComplexModes pointOf(const modes::Modes& free, const contact::CoupledSystem& system,
                             int count) {
  pencil::ComplexModes point;
  std::vector<std::size_t> indices;
  std::vector<linalg::ComplexVector> vectors;
  for (int i = 0; i < count; ++i) {
    point.eigenvalues.push_back({.s = {0, free.angularFrequency[i]}});
    indices.push_back(i);
    Vec column = nullptr;
    check(BVGetColumn(free.vectors, i, &column));
    const OwnedVec zeros = rightVector(system.k0());
    vectors.push_back(linalg::ComplexVector::copied(column, zeros));
    check(BVRestoreColumn(free.vectors, i, &column));
  }
  pencil::storeShapes(point, system.transformation().trial, indices, std::move(vectors));
  return point;
}

// With ω² = dᵀK d / dᵀM d and bodies g,
//   ds/d ln E_g = s dᵀK_g d / (2 dᵀK d),   ds/d ln ρ_g = −s dᵀM_g d / (2 dᵀM d).
// No other parameter counts. The supports have springs, so the shares of the bodies do not add up
// to one half.
TEST(Influences, AreSharesOfTheEnergies) {
  setOptions(floatingPad +
             " -contact_main_separation off -contact_other_separation off -modes_count 12");
  const auto model = buildModel();
  const contact::CoupledSystem system(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  const auto free = modes::compute(system, modes::Settings::given());
  auto point = pointOf(free, system, 4);
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const auto solution = problem.solve({0}, system);
  ASSERT_TRUE(solution.converged) << solution.reason;
  const auto pencil = terms::affineTerms(model.contact, system);
  terms::Influences influences(*model.mesh, model.bodies, model.contact,
                               {.frictionDamping = false});
  influences.derive(point, pencil, {point.at, system, solution},
                    {linalg::ReadColumns(free.vectors).view(), system.m0(), {}});
  ASSERT_EQ(point.sensitivities.size(), 4u);
  const auto& groups = model.mesh->materialGroups;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& shape = point.shapes[i];
    const Complex s = point.eigenvalues[shape.index].s;
    ASSERT_TRUE(point.sensitivities[i].regular());
    std::map<std::string, Complex> expected;
    for (int group = 0; group < std::ssize(groups); ++group) {
      const auto part = elasticity::materialPart(*model.mesh, model.bodies, group);
      expected["young_" + groups[group].name] =
          s * quadraticForm(part.stiffness, shape.real) /
          (2 * quadraticForm(model.bodies.stiffness, shape.real));
      expected["density_" + groups[group].name] =
          -s * quadraticForm(part.mass, shape.real) /
          (2 * quadraticForm(model.bodies.mass, shape.real));
    }
    for (const char* name : {"speed", "pressure", "damping"}) expected[name] = 0;
    for (const auto& [name, value, second] : point.sensitivities[i].derivatives) {
      if (name == "friction") continue;  // no energy: it is not symmetric
      ASSERT_TRUE(expected.contains(name)) << name;
      print("mode %d, %s: %.6f of s\n", int(i), name.c_str(), (value / s).real());
      // The square of the errors of both vectors, which have residuals of 1e-8 at most.
      EXPECT_LT(std::abs(value - expected[name]), 1e-8 * std::abs(s)) << name;
    }
    EXPECT_EQ(point.sensitivities[i].derivatives.size(), expected.size() + 1);
    EXPECT_NEAR(point.sensitivities[i].condition, 1, 1e-6);  // of a symmetric problem
  }
}

}  // namespace
}  // namespace squeal::test
