// SPDX-License-Identifier: BSD-2-Clause
// Springs, bushings and point masses between reference nodes, against closed forms: chains of
// masses, rigid blocks on a bushing, and motions that must cost no energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/petsc/arrays.hpp"
#include "base/system/text.hpp"
#include "eigen/modes/modes.hpp"
#include "model/contact/coupled.hpp"
#include "support/harness/messages.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using mesh::Point;

/// A program has a mesh: here a small stiff box that is held at one end, whose lowest frequency is
/// above 1e4 rad/s, 1e3 times that of the chains.
const std::string box =
    "-mesh_file meshes/beam.geo -mesh_set nx=3,ny=1,nz=1,Lx=0.1,Ly=0.1,Lz=0.1 " +
    test::material("beam", "2e11", "0.3", "8000") + "-constraint_clamped_clamped xyz ";

/// Collective. Returns ω² of the lowest modes, rad²/s².
std::vector<double> lambdas(int count, const std::string& options) {
  test::setOptions(box + "-modes_count " + std::to_string(count) + " " + options);
  const auto model = test::buildModel();
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  auto found = modes::compute(system, modes::Settings::given()).lambda;
  found.resize(count);
  return found;
}

std::string node(const std::string& name, const std::string& position,
                 const std::string& mass = "1") {
  return "-reference_" + name + "_position " + position + " -mass_" + name + "_total " + mass + " ";
}

TEST(Attachments, ChainOfMassesAndSprings) {
  // n equal masses and springs between two walls: ω² = 4 k/m sin²(i π / (2 n + 2)), here along a
  // slanted line, with all other motions held. m = 3, k = 700.
  std::string options;
  for (int i = 0; i <= 4; ++i) {
    const std::string name(1, char('a' + i));
    options += node(name, formatted("%d,%d,0", 3 * i, 4 * i), "3") + "-constraint_" + name +
               "_clamped_rotation xyz ";
    if (i == 0 || i == 4)
      options += "-constraint_" + name + "_clamped xyz ";
    else
      options += "-constraint_" + name + "_clamped yz -constraint_" + name + "_frame line ";
    if (i > 0)
      options += formatted("-spring_s%d_from %c -spring_s%d_to %c -spring_s%d_stiffness 700 ", i,
                           'a' + i - 1, i, 'a' + i, i);
  }
  options += "-frame_line_x 3,4,0 -frame_line_xy 0,1,0";
  const auto found = lambdas(3, options);
  for (int i = 1; i <= 3; ++i)
    EXPECT_NEAR(found[i - 1] / (4 * 700.0 / 3 * std::pow(std::sin(i * M_PI / 8), 2)), 1, 1e-9);
  // The same chain through equations in place of supports in a frame: 4 x = 3 y.
  std::string byEquations = options;
  for (const std::string name : {"b", "c", "d"}) {
    const std::string frame = "-constraint_" + name + "_frame line ",
                      held = "-constraint_" + name + "_clamped yz ";
    byEquations.replace(byEquations.find(held), held.size(),
                        "-constraint_" + name + "_clamped z -equation_" + name + " '4*" + name +
                            ":x - 3*" + name + ":y = 0' ");
    byEquations.replace(byEquations.find(frame), frame.size(), "");
  }
  const auto again = lambdas(3, byEquations);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(again[i] / found[i], 1, 1e-9);
}

TEST(Attachments, RigidBlocksOnABushing) {
  // Two blocks, each with mass m and inertia J about its centre, held together by a bushing with
  // six components at the middle between them. Both centres lie on the
  // x axis at ∓ a from the middle. The relative motions have closed forms: along x and about x
  // 2 k/m and 2 κ/J; in the plane of y with rotation about z the relative displacement at the
  // bushing couples with the equal rotations of both blocks.
  const double m = 2, a = 0.5;
  const Point k{900, 400, 1600}, kappa{30, 70, 50}, j{0.2, 0.3, 0.5};
  const std::string blocks =
      node("p", "-0.5,0,0", "2") + node("q", "0.5,0,0", "2") +
      "-mass_p_inertia 0.2,0.3,0.5,0,0,0 -mass_q_inertia 0.2,0.3,0.5,0,0,0 "
      "-bushing_b_from p -bushing_b_to q -bushing_b_stiffness 900,400,1600,30,70,50 "
      // to the ground, 10 times the mass: all eigenvalues rise by 10
      "-bushing_g_from p -bushing_g_stiffness 20,20,20,2,3,5 "
      "-bushing_h_from q -bushing_h_stiffness 20,20,20,2,3,5 ";
  // Symmetric motions, equal and opposite: u_q = −u_p, θ_q = −θ_p: δ = 2 u, φ = 2 θ, without
  // coupling, as the arms give δ_y = 2 u_y − a θ_z + a θ_z. Antisymmetric ones, with equal
  // rotations θ and opposite displacements, δ_y = 2 u_y − 2 a θ_z: one mode, with
  // 1/m_eff = (2/m + 2 a²/J) for the form δ_y.
  std::vector<double> expected{2 * k[0] / m,
                               2 * kappa[0] / j[0],
                               2 * kappa[1] / j[1],
                               2 * kappa[2] / j[2],
                               k[1] * (2 / m + 2 * a * a / j[2]),
                               k[2] * (2 / m + 2 * a * a / j[1])};
  std::ranges::sort(expected);
  const auto found = lambdas(12, blocks);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], 10, 1e-8) << i;  // rigid motions
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[6 + i] / (10 + expected[i]), 1, 1e-9) << i;
  // Turned as a whole the blocks have the same frequencies.
  const std::string turned =
      node("p", "-0.3,-0.4,0", "2") + node("q", "0.3,0.4,0", "2") +
      "-mass_p_inertia 0.2,0.3,0.5,0,0,0 -mass_q_inertia 0.2,0.3,0.5,0,0,0 "
      "-mass_p_frame f -mass_q_frame f -bushing_b_frame f -bushing_g_frame f "
      "-bushing_h_frame f -frame_f_x 3,4,0 -frame_f_xy 0,1,0 "
      "-bushing_b_from p -bushing_b_to q -bushing_b_stiffness 900,400,1600,30,70,50 "
      "-bushing_g_from p -bushing_g_stiffness 20,20,20,2,3,5 "
      "-bushing_h_from q -bushing_h_stiffness 20,20,20,2,3,5 ";
  const auto again = lambdas(12, turned);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(again[6 + i] / (10 + expected[i]), 1, 1e-9) << i;
}

TEST(Attachments, OffsetMassIsThatOfItsCentre) {
  // A pendulum about z: J + m r² on a torsion spring κ; the reference node is held.
  const std::string pendulum =
      "-reference_r_position 1,2,3 -constraint_r_clamped xyz -constraint_r_clamped_rotation xy "
      "-bushing_t_from r -bushing_t_stiffness 0,0,0,0,0,80 ";
  const auto found = lambdas(1, pendulum +
                                    "-mass_r_total 5 -mass_r_offset 0.3,-0.4,0.7 "
                                    "-mass_r_inertia 0.2,0.2,0.3,0.1,0,0.05");
  EXPECT_NEAR(found[0] / (80 / (0.3 + 5 * 0.25)), 1, 1e-9);
}

TEST(Attachments, TipMassOnARigidCoupling) {
  // A cantilever of 10 × 3 × 3 hex8 without incompatible modes, E = 1e6, ν = 0.3, ρ = 1, with a
  // mass of 1 at the reference node of its end. Pull request 33820 of MOOSE reports
  // ω² = 999.269 for its RBE2 constraint, in six digits.
  test::setOptions(
      "-mesh_file meshes/beam.geo -mesh_set Lx=5,Ly=1,Lz=1,nx=10,ny=3,nz=3 " +
      test::material("beam", "1e6", "0.3", "1") +
      "-constraint_clamped_clamped xyz -elasticity_incompatible_modes none -modes_count 2 "
      "-reference_r_centre_of tip -coupling_c_reference r -coupling_c_nodes tip -mass_r_total 1");
  const auto model = test::buildModel();
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  EXPECT_NEAR(modes::compute(system, modes::Settings::given()).lambda[0], 999.269, 6e-4);
}

/// Collective. Returns the largest force on a node that a rigid motion causes, relative to the
/// largest entry of the stiffness of the links.
double forceOfRigidMotion(const std::string& options) {
  test::setOptions(box + options);
  const auto model = test::buildModel();
  const auto& mesh = *model.mesh;
  const OwnedVec u = test::rigidMotion(mesh, {0.3, -0.2, 0.5}, {0.7, 0.4, -0.9});
  const OwnedVec force = elasticity::nodalVector(mesh);
  check(MatMult(model.bodies.linkStiffness, u, force));
  PetscReal largest = 0, entry = 0;
  check(VecNorm(force, NORM_INFINITY, &largest));
  check(MatNorm(model.bodies.linkStiffness, NORM_INFINITY, &entry));
  return largest / entry;
}

TEST(Attachments, RigidMotionsCostNoEnergy) {
  const std::string ends =
      "-reference_r_position 1,2,3 -coupling_c_reference r -coupling_c_nodes tip "
      "-reference_s_position 0.5,1.7,2 -coupling_d_reference s -coupling_d_nodes top "
      "-coupling_d_kind distributed ";
  // Round-off of a few operations on numbers of magnitude 10.
  EXPECT_LT(forceOfRigidMotion(ends + "-bushing_b_from r -bushing_b_to s "
                                      "-bushing_b_stiffness 3e3,4e4,5e5,60,700,8000 "
                                      "-bushing_b_frame f -frame_f_axis 1,1,0.5"),
            1e-13);
  EXPECT_LT(forceOfRigidMotion(ends + "-spring_b_from r -spring_b_to s -spring_b_stiffness 3e3"),
            1e-13);
}

TEST(Attachments, LoadsAreNodalForces) {
  test::setOptions(box +
                   "-reference_r_position 1,2,3 -coupling_c_reference r -coupling_c_nodes tip "
                   "-mass_r_total 5 -mass_r_offset 0.1,0,0 -load_gravity 0,0,-10 "
                   "-load_r_force 1,2,3 -load_r_moment 4,5,6 -load_r_frame f -load_r_hydraulic off "
                   "-frame_f_x 0,1,0 -frame_f_xy 0,0,1 -load_top_force 0,0,-8 "
                   "-load_beam_acceleration 2,0,0");
  const auto model = test::buildModel();
  const auto& mesh = *model.mesh;
  const auto& reference = *mesh.reference("r");
  Point atReference{}, moment{}, all{};
  const ReadArray load(model.bodies.load);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    for (std::size_t d = 0; d < 3; ++d) {
      const double value = load[3 * node + d];
      const PetscInt global = mesh.firstNode + node;
      if (global == reference.displacement) atReference[d] += value;
      if (global == reference.rotation)
        moment[d] += value;
      else
        all[d] += value;
    }
  for (std::size_t d = 0; d < 3; ++d) {
    atReference[d] = test::total(atReference[d]);
    moment[d] = test::total(moment[d]), all[d] = test::total(all[d]);
  }
  // Local x, y, z are y, z, x. Weight 50 at the arm 0.1 along x: a moment 5 about y.
  const Point force{3, 1, 2 - 50}, expected{6, 4 + 5, 5};
  const double mass = 8;  // of the box, 8000 · 0.001
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(atReference[d], force[d], 1e-12) << d;
    EXPECT_NEAR(moment[d], expected[d], 1e-12) << d;
  }
  EXPECT_NEAR(all[0], 3 + 2 * mass, 1e-10);
  EXPECT_NEAR(all[1], 1, 1e-10);
  EXPECT_NEAR(all[2], 2 - 50 - 8 - 10 * mass, 1e-10);
}

// Points that coincide, and points on an axis, up to round-off of their coordinates have no
// direction: any would be as good.
TEST(Attachments, DirectionsOfRoundingAreRefused) {
  const std::string r = "-reference_r_position 1,2,3 -constraint_r_clamped xyz "
                        "-constraint_r_clamped_rotation xyz ",
                    // half a unit in the last place or one, and 1e-10 of the box of 0.17 m
      near = "-reference_s_position 1,2.0000000000000004,3 ",
                    axis = "-frame_f_axis 0,0,1 -frame_f_origin 1.0000000000000002,2,0 ",
                    box0 = "-frame_f_axis 1,0,0 -frame_f_origin 0,1e-11,0.05 ",
                    n = "-reference_n_position ";
  const std::string point = " f: the point (1, 2, 3) m lies on the axis of the cylindrical frame";
  const std::vector<std::pair<std::string, std::string>> faults{
      {r + near + "-spring_a_from r -spring_a_to s -spring_a_stiffness 1",
       "option -spring_a_to: both ends lie at (1, 2, 3)"},
      {r + axis + "-bushing_a_from r -bushing_a_stiffness 1,2,3 -bushing_a_frame f",
       "option -bushing_a_frame" + point},
      {r + axis + "-mass_r_total 1 -mass_r_offset 1,0,0 -mass_r_frame f",
       "option -mass_r_frame" + point},
      {r + axis + "-constraint_r_frame f", "option -constraint_r_frame" + point},
      {r + axis + "-load_r_moment 1,0,0 -load_r_frame f", "option -load_r_frame" + point},
      {r + axis + "-load_r_force 1,0,0 -load_r_frame f", "option -load_r_frame" + point},
      {n + "0,0,0.05 -constraint_n_clamped xyz -constraint_n_clamped_rotation xyz " + box0 +
           "-bushing_a_from n -bushing_a_stiffness 1,2,3 -bushing_a_frame f",
       "option -bushing_a_frame f: the point (0, 0, 0.05) m lies on the axis"},
      {box0 + "-ground_tip_stiffness 1,1,1 -ground_tip_frame f", ""},  // its nodes are off the axis
  };
  for (const auto& [options, message] : faults) {
    const std::string found = test::errorOf([&, &text = options] {
      test::setOptions(box + text);
      test::buildModel();
    });
    EXPECT_NE(found.find(message), std::string::npos) << options << "\n  " << found;
    EXPECT_EQ(found.empty(), message.empty()) << options << "\n  " << found;
  }
}

TEST(Attachments, FaultsAreNamed) {
  const std::string r = "-reference_r_position 1,2,3 ", s = "-reference_s_position 1,2,4 ";
  const std::vector<std::pair<std::string, std::string>> faults{
      {"-spring_a_from tip -spring_a_to top -spring_a_stiffness 1",
       "option -spring_a_from: group 'tip' has several nodes; it must have one"},
      {"-spring_a_from r -spring_a_stiffness 1", "option -spring_a_from needs -spring_a_to"},
      {"-spring_a_stiffness 1", "option -spring_a_stiffness needs -spring_a_from"},
      {r + "-spring_a_from r -spring_a_to r -spring_a_stiffness 1",
       "option -spring_a_to: both ends lie at (1, 2, 3)"},
      {r + s + "-spring_a_from r -spring_a_to s",
       "option -spring_a_from needs -spring_a_stiffness or -spring_a_damping"},
      {r + "-spring_a_from r -spring_a_to t -spring_a_stiffness 1",
       "option -spring_a_to names group 't', which is not in the mesh"},
      {r + "-bushing_a_from r -bushing_a_stiffness 1,2",
       "option -bushing_a_stiffness: 2 components; must have 3 or 6"},
      {r + "-bushing_a_from r -bushing_a_stiffness 1,2,3 -bushing_a_frame f",
       "option -bushing_a_frame f: no frame has this name"},
      {r + "-bushing_a_from r -bushing_a_stiffness 1,2,-3", "option -bushing_a_stiffness"},
      {"-mass_tip_total -1", "option -mass_tip_total -1"},
      {"-mass_tip_total 1 -mass_tip_offset 1,0,0",
       "option -mass_tip_offset: 'tip' is not a reference node"},
      {r + "-mass_r_total 1 -mass_r_inertia 1,1,3,0,0,0",
       "option -mass_r_inertia: the principal moments of inertia are 1, 1 and 3 kg m2"},
      {r + "-mass_r_total 1 -mass_r_inertia 1,1", "option -mass_r_inertia: 2 numbers; must be six"},
      {"-mass_tip_inertia 1,1,1,0,0,0", "option -mass_tip_inertia needs -mass_tip_total"},
      {"-load_tip_moment 1,0,0", "option -load_tip_moment: 'tip' is not a reference node"},
      {"-load_tip_force 1,0,0 -load_tip_frame f -frame_f_axis 1,0,0 -frame_f_origin 0,0.05,0.05",
       "option -load_tip_frame f: the point"},
      {r + "-bushing_a_from r -bushing_a_to r -bushing_a_stiffness 1,1,1",
       "option -bushing_a_to r: both ends are the same node"},
      {"-load_tip_acceleration 1,0,0", "option -load_tip_acceleration: 'tip' is not a body"},
      {"-load_tip_hydraulic off", "option -load_tip_hydraulic needs -load_tip_pressure"},
      {"-load_beam_spin_axis 1,0,0", "option -load_beam_spin_axis needs -load_beam_spin"},
      {"-load_beam_spin 1 -load_beam_spin_axis 0,0,0",
       "option -load_beam_spin_axis: the axis has no length"},
      {"-load_beam_spin 1 -motion_beam_velocity 0,1,0",
       "option -load_beam_spin: the body translates (-motion_beam_velocity)"},
      {"-motion_beam_speed 1 -motion_beam_axis 0,0,0",
       "option -motion_beam_axis: the axis has no length"},
      {"-motion_beam_origin 1,0,0",
       "option -motion_beam_origin needs -motion_beam_speed or -motion_beam_rpm"},
      {"-motion_beam_velocity 1,0,0 -motion_beam_axis 1,0,0",
       "option -motion_beam_axis needs -motion_beam_speed or -motion_beam_rpm"},
      {r + s +
           "-spring_upper_from r -spring_upper_to s -spring_upper_stiffness 1 "
           "-spring_uper_damping 1",
       "option -spring_uper_damping needs -spring_uper_from; did you mean -spring_upper_damping?"},
      {r + "-mass_r_total 1",
       "body 'reference node r' can move rigidly with closed frictionless contact (translation"},
      {r + "-mass_r_total 1",
       "-constraint_<group>_clamped, -constraint_<name>_clamped_rotation, -ground_"},
  };
  for (const auto& [options, message] : faults) {
    const auto given = [&, &text = options] {
      test::setOptions(box + text);
      validateGivenOptions();
      test::buildModel();
    };
    const std::string found = test::errorOf(given);
    EXPECT_NE(found.find(message), std::string::npos) << options << "\n  " << found;
  }
}

}  // namespace
}  // namespace squeal
