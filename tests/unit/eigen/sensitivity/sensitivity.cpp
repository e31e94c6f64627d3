// SPDX-License-Identifier: BSD-2-Clause
// Derivatives of eigenvalues against finite differences of whole runs, and the balance of friction
// work.
#include "eigen/sensitivity/sensitivity.hpp"

#include <gtest/gtest.h>

#include "support/eigen/sensitivity_checks.hpp"

namespace squeal {
namespace {

using test::sensitivities::Configuration;
using test::sensitivities::expectBalance;
using test::sensitivities::expectDifferences;
using test::sensitivities::run;

void expectDerivatives(const Configuration& model) {
  const analysis::Analysis analysis = run(model, "", 1);
  expectBalance(analysis, analysis.flutter.segments.at(0).points.at(0));
  expectDifferences(model, analysis);
}

const std::string coarseLayers =
    "-mesh_set nx=8,ny_disc=3,ny_pad=2 -modes_count 40 -flutter_method direct "
    "-flutter_direct_count 400";

TEST(Sensitivity, OfApproximationAWithDampedBodies) {
  expectDerivatives(
      {.name = "two_layers",
       .options = coarseLayers,
       .attached = {{"damping_disc", {{"material_disc_rayleigh_mass", {0.01}}}},
                    {"damping_pad", {{"material_pad_rayleigh_stiffness", {0.002}}}}}});
}

// The full terms of moving matter, a friction law that falls with speed, and prestress: every term
// of the point follows the steady state.
TEST(Sensitivity, OfMovingMatterWithAFrictionLaw) {
  expectDerivatives({"two_layers_moving",
                     "-mesh_set nx=4,ny_disc=2,ny_pad=2,order=2 -modes_count 80 -flutter_method "
                     "direct -flutter_direct_count 400 "
                     "-friction_law exponential -friction_static_ratio 1.5 -friction_decay_speed "
                     "0.05 -elasticity_prestress on "
                     "-flutter_shapes_below 2.4 "
                     "-flutter_shapes_below 2.2"});
}

// Friction damping in a solid that slides at an angle to its waves: it grows with the pressure and
// falls with speed.
TEST(Sensitivity, OfFrictionDamping) {
  expectDerivatives(
      {"two_layers_antiplane",
       "-mesh_set nx=6,ny_disc=2,ny_pad=1,order=1 -modes_count 40 -motion_convective on "
       "-motion_disc_velocity 0.05,0,0.03"});
}

// Equivalent viscous damping follows the moduli, and not the density.
TEST(Sensitivity, OfLossFactors) {
  expectDerivatives(
      {.name = "two_layers",
       .options =
           coarseLayers + " -material_disc_loss_frequency 0.3 -material_pad_loss_frequency 0.5",
       .attached = {{"damping_disc", {{"material_disc_loss_factor", {0.004}}}},
                    {"damping_pad", {{"material_pad_loss_factor", {0.02}}}}}});
}

// Axes turned in the disc, and with the place in the pad; the steady stress of both joins the
// stiffness.
TEST(Sensitivity, OfOrthotropicBodies) {
  const Configuration model{
      "",
      "-mesh_file meshes/two_layers.geo -mesh_set nx=8,ny_disc=3,ny_pad=2 -motion_disc_velocity "
      "1,0,0 "
      "-constraint_disc_bottom_clamped xy -constraint_pad_top_clamped xy "
      "-constraint_pad_top_displacement 0,-0.01,0 "
      "-constraint_disc_right_image_of disc_left -constraint_pad_right_image_of pad_left "
      "-contact_interface_pad pad_face "
      "-contact_interface_disc disc_face -material_disc_orientation 0.8,0.6,0,-0.6,0.8,0 "
      "-material_pad_cylindrical 1,-4,0,0,0,1 -elasticity_prestress on "
      "-modes_count 40 -flutter_method direct -flutter_direct_count 400",
      0.4,
      {{"disc", {{1.2, 0.9, 1.0, 0.3, 0.25, 0.28, 0.45, 0.4, 0.4}, 1.0}},
       {"pad", {{0.5, 0.3, 0.4, 0.25, 0.2, 0.3, 0.14, 0.15, 0.15}, 0.6}}}};
  expectDerivatives(model);
}

// A block on a bushing with a mass, and a spring to its side; their forces change the steady
// stress.
TEST(Sensitivity, OfBushingsSpringsAndMasses) {
  Configuration model{
      "",
      "-mesh_file meshes/layer_slab.geo -mesh_set Lx=0.5,nx=3,ny=3,nz=1,depth=0.3 "
      "-material_layer_poisson 0.3 -reference_r_position 0.2,-1.2,0.1 -coupling_r_reference r "
      "-coupling_r_nodes bottom -bushing_b_from r -reference_t_position 0.6,-0.4,0.1 "
      "-coupling_t_reference t -coupling_t_nodes right -coupling_t_kind distributed "
      "-spring_s_from r -spring_s_to t -load_gravity "
      "0,0.02,0 "
      "-contact_plate_pad top "
      "-contact_plate_obstacle_velocity 1,0,0.2 -contact_plate_obstacle_displacement 0,-0.01,0 "
      "-elasticity_prestress on -modes_count 40 -flutter_method direct -flutter_direct_count 400",
      0.4,
      {{"layer", {{1.0}, 1.0}}},
      {{"bushing_b_stiffness", {{"bushing_b_stiffness", {0.5, 0.7, 0.6, 0.1, 0.2, 0.15}}}},
       {"bushing_b_damping",
        {{"bushing_b_damping", {0.001, 0.002, 0.001, 0.0001, 0.0001, 0.0002}}}},
       {"spring_s_stiffness", {{"spring_s_stiffness", {0.3}}}},
       {"mass_r", {{"mass_r_total", {0.1}}, {"mass_r_inertia", {0.01, 0.02, 0.015, 0, 0, 0}}}}}};
  expectDifferences(model, run(model, "", 1));
}

void expectDerivativesOfOpenContact(const Configuration& model) {
  const analysis::Analysis analysis = run(model, "", 1);
  const auto open = analysis.flutter.segments.at(0).openNodes;
  EXPECT_GT(open, 0);
  EXPECT_LT(open, analysis.model.contact.interfaces.totalNodes);
  expectBalance(analysis, analysis.flutter.segments[0].points.at(0));
  expectDifferences(model, analysis);
}

// Blocks that friction lifts off at the leading edge: prestress moves with the gaps of the open
// nodes, what friction does with relative velocities with the forces of the closed ones. First
// across the sliding direction, on a rigid plate,
TEST(Sensitivity, OfOpenContactWithFrictionDamping) {
  expectDerivativesOfOpenContact(
      {"",
       "-mesh_file meshes/layer_slab.geo -mesh_set Lx=0.5,nx=4,ny=4,nz=1,depth=0.3 "
       "-material_layer_poisson 0.3 "
       "-constraint_bottom_clamped xyz -contact_plate_pad top -contact_plate_obstacle_velocity "
       "1,0,0.2 "
       "-contact_plate_obstacle_displacement 0,-0.01,0 -elasticity_prestress on "
       "-modes_count 40 -flutter_method direct -flutter_direct_count 400",
       0.4,
       {{"layer", {{1.0}, 1.0}}}});
}

// then along it, by a law that falls with speed, on a deformable body.
TEST(Sensitivity, OfOpenContactWithAFrictionLaw) {
  expectDerivativesOfOpenContact(
      {"",
       "-mesh_file meshes/two_layers.geo -mesh_set nx=6,ny_disc=3,ny_pad=6,Lx=0.6,h_pad=1 "
       "-material_disc_poisson 0.3 "
       "-material_pad_poisson 0.25 -motion_disc_velocity 0.05,0,0 -constraint_disc_bottom_clamped "
       "xy -constraint_pad_top_clamped "
       "xy "
       "-constraint_pad_top_displacement 0,-0.02,0 -contact_interface_pad pad_face "
       "-contact_interface_disc disc_face "
       "-friction_law exponential -friction_static_ratio 1.5 -friction_decay_speed 0.05 "
       "-elasticity_prestress on "
       "-flutter_shapes_below 2.4 "
       "-modes_count 40 -flutter_method direct -flutter_direct_count 400",
       0.5});
}

}  // namespace
}  // namespace squeal
