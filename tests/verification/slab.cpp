// SPDX-License-Identifier: BSD-2-Clause
// The layer as a solid slab one cell thick, held in z: the plane-strain answers, cell type by cell
// type.
#include <gtest/gtest.h>

#include "exact/one_layer.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

// Of the displacements in the plane, those that do not vary in z span the plane problem exactly:
// Gauss rules, consistent and diagonal mass are tensor products. Those that do vary shear the cell
// across its small depth and lie far above.
void expectPlaneStrain(const std::string& mesh, const std::string& options) {
  const std::string common =
      " -elasticity_incompatible_modes none -flutter_friction 0,0.4 -flutter_method direct "
      "-flutter_direct_count 40 " +
      options;
  const analysis::Analysis plane = runCase("layer", "-mesh_set " + mesh + common);
  const analysis::Analysis slab =
      runCase("layer", "-mesh_file meshes/layer_slab.geo -constraint_layer_clamped z -mesh_set " +
                           mesh + common);
  EXPECT_EQ(slab.model.mesh->dimension, 3);
  ASSERT_EQ(slab.flutter.segments.size(), 1U);
  const double pressure = exact::one_layer::Steady{0.4, 0.01}.pressure();
  EXPECT_NEAR(slab.steady.solutions.at(1).smallestPressure / pressure, 1, 1e-10);
  for (std::size_t i = 0; i < 2; ++i) {
    auto wanted = eigenvaluesOf(plane.flutter.segments.at(0).points.at(i));
    wanted.resize(30);
    const auto& found = slab.flutter.segments[0].points.at(i);
    const double difference = worst(errors(wanted, eigenvaluesOf(found)).relative);
    print("%s %s, f = %g: slab against plane %.1e\n", mesh.c_str(), options.c_str(),
          found.at.friction, difference);
    EXPECT_LT(difference, 1e-8);
    // The same lowest ones, not only among more.
    EXPECT_NEAR(found.eigenvalues.at(29).s.imag(), wanted[29].imag(), 1e-8 * wanted[29].imag());
  }
}

TEST(Slab, Hex8IsQuad4) { expectPlaneStrain("nx=36,ny=12", "-elasticity_mass higher_order"); }
TEST(Slab, Hex8IsQuad4WithConsistentMass) {
  expectPlaneStrain("nx=36,ny=12", "-elasticity_mass consistent");
}
TEST(Slab, Hex27IsQuad9) { expectPlaneStrain("order=2,nx=12,ny=4", "-elasticity_mass consistent"); }
TEST(Slab, Hex27IsQuad9WithHigherOrderMass) {
  expectPlaneStrain("order=2,nx=12,ny=4", "-elasticity_mass higher_order");
}

}  // namespace
}  // namespace squeal::test
