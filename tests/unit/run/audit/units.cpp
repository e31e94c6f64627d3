// SPDX-License-Identifier: BSD-2-Clause
// Findings on units: lengths, moduli, densities, pressures and gravity.
#include <gtest/gtest.h>

#include <cmath>

#include "support/run/audited_blocks.hpp"

namespace squeal {
namespace {

using test::missingIn;

TEST(Units, LengthsInMillimetres) {
  const auto options = test::oneBlock("audit_mm.msh", {100, 50, 10}, "2.1e11", "7850");
  EXPECT_EQ(missingIn(test::audited(options), 1,
                      {"units (warning)", "100 m from (0, 0, 0) to (100, 50, 10)",
                       "a mass of 3.925e+08 kg", "its lengths look like mm", "-mesh_scale 0.001"}),
            "");
  EXPECT_EQ(missingIn(test::audited(options + "-mesh_scale 0.001"), 0, {}), "");
}

TEST(Units, ConsistentMillimetres) {
  EXPECT_EQ(
      missingIn(test::audited(test::oneBlock("audit_t.msh", {100, 50, 10}, "2.1e5", "7.85e-9")), 0,
                {}),
      "");
  EXPECT_EQ(missingIn(test::audited(
                          test::oneBlock("audit_t_m.msh", {0.1, 0.05, 0.01}, "2.1e5", "7.85e-9")),
                      1, {"its lengths look like m", "-mesh_scale 1000"}),
            "");
}

TEST(Units, ModulusAndDensity) {
  const mesh::Point size{0.1, 0.05, 0.01};
  EXPECT_EQ(missingIn(test::audited(test::oneBlock("audit_mpa.msh", size, "2.1e5", "7850")), 1,
                      {"body 'box'", "5.17 m/s", "looks like MPa or GPa", "-material_box_young"}),
            "");
  EXPECT_EQ(missingIn(test::audited(test::oneBlock("audit_gram.msh", size, "2.1e11", "7.85")), 1,
                      {"body 'box'", "the density looks like g/cm3", "-material_box_density"}),
            "");
  EXPECT_EQ(missingIn(test::audited(test::oneBlock("audit_tonne.msh", size, "2.1e11", "7.85e-9")),
                      1, {"the density looks like t/mm3"}),
            "");
}

// The largest of the Young's moduli along the axes gives the wave speed.
TEST(Units, OrthotropicBody) {
  const auto options = test::oneBlock("audit_orthotropic.msh", {0.1, 0.05, 0.01}, "2.1e11", "7850");
  const auto found = test::audited(test::changed(
      test::changed(options, "-material_box_young 2.1e11", ""), "-material_box_poisson 0.3",
      "-material_box_engineering_constants 4e9,1e9,2e9,0.3,0.2,0.1,1e9,1e9,1e9"));
  EXPECT_NEAR(found.waveSpeed.at(0), std::sqrt(4e9 / 7850), 1e-9);
  EXPECT_EQ(test::linesOf(found), "");
}

// Findings name the section, and the pressure is that on the section which it loads.
TEST(Units, Sections) {
  const std::string plate =
      "-mesh_file meshes/laminate.geo -material_plate_sections lower,upper "
      "-material_plate_young 2e11 -material_plate_poisson 0.3 -material_plate_density 7800 "
      "-constraint_bottom_clamped xyz ";
  EXPECT_EQ(missingIn(test::audited(plate), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(plate + "-material_upper_density 7.8"), 1,
                      {"section 'upper' of body 'plate': a modulus", "-material_upper_density"}),
            "");
  const std::string soft = plate + "-material_upper_young 1e7 -load_top_pressure 2e6 ";
  EXPECT_EQ(missingIn(test::audited(soft), 1,
                      {"the pressure of 2e+06 Pa on 'top' of section 'upper' of body 'plate'",
                       "0.2 times its modulus of 1e+07 Pa"}),
            "");
  EXPECT_NEAR(test::audited(soft).waveSpeed.at(0), std::sqrt(2e11 / 7800), 1e-9);
  EXPECT_EQ(missingIn(test::audited(plate + "-material_upper_young 1e7 -load_left_pressure 2e6 "),
                      1, {"on 'left' of section 'upper' of body 'plate'"}),
            "");
  EXPECT_EQ(missingIn(test::audited(plate + "-material_lower_poisson 0.4999 "
                                            "-elasticity_incompatible_modes none "),
                      1, {"section 'lower' of body 'plate' is nearly incompressible"}),
            "");
}

TEST(Units, Pressure) {
  const auto options = test::oneBlock("audit_p.msh", {0.1, 0.05, 0.01}, "2.1e11", "7850");
  const std::string load = " -load_box_x0_pressure ";
  EXPECT_EQ(missingIn(test::audited(options + load + "1e6"), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(options + load + "1.5"), 1,
                      {"pressure of 1.5 Pa on 'box_x0' of body 'box'", "looks like MPa",
                       "-load_box_x0_pressure in Pa"}),
            "");
  EXPECT_EQ(missingIn(test::audited(options + load + "4.2e11"), 1,
                      {"is 2 times its modulus of 2.1e+11 Pa"}),
            "");
}

TEST(Units, Gravity) {
  const auto si = test::oneBlock("audit_g.msh", {0.1, 0.05, 0.01}, "2.1e11", "7850"),
             mm = test::oneBlock("audit_g_mm.msh", {100, 50, 10}, "2.1e5", "7.85e-9");
  EXPECT_EQ(missingIn(test::audited(si + "-load_gravity 0,0,-9.81"), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(si + "-load_gravity 0,0,-9810"), 1,
                      {"gravity of 9810 m/s2 looks like mm/s2", "-load_gravity in m/s2"}),
            "");
  EXPECT_EQ(missingIn(test::audited(mm + "-load_gravity 0,0,-9810"), 0, {}), "");
  EXPECT_EQ(missingIn(test::audited(mm + "-load_gravity 0,0,-9.81"), 1,
                      {"gravity of 9.81 m/s2 looks like m/s2", "-load_gravity in mm/s2"}),
            "");
}

}  // namespace
}  // namespace squeal
