// SPDX-License-Identifier: BSD-2-Clause
// The same case in metres, kilograms and seconds, and in millimetres, tonnes and seconds (N, MPa):
// nothing in the program is tied to the size of a number. Frequencies and growth rates are in Hz
// and 1/s in both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/cad_shape.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

using analysis::Analysis;

/// The numbers of both runs are powers of ten apart, which rounds them by 1e-16 each. Corrections
/// go on until the estimated error, a hundred times too large, is below 1e-10.
const std::string tight = " -flutter_tolerance 1e-10 ";
constexpr double asNear = 1e-9;

PetscReal largestDisplacement(const Analysis& run, std::size_t point) {
  PetscReal largest = 0;
  check(VecNorm(run.steady.solutions.at(point).displacement, NORM_INFINITY, &largest));
  return largest;
}

/// Collective. Checks that a run in mm, t, s is the run in m, kg, s.
void expectTheSame(const Analysis& metres, const Analysis& millimetres) {
  ASSERT_TRUE(metres.converged() && millimetres.converged());
  ASSERT_EQ(metres.model.mesh->totalNodes, millimetres.model.mesh->totalNodes);
  const auto points = metres.sweep.points();
  bool grows = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto *a = metres.pointAt(points[i]), *b = millimetres.pointAt(points[i]);
    ASSERT_TRUE(a && b);
    expectSpectrum(eigenvaluesOf(*b), eigenvaluesOf(*a), asNear);
    for (const auto& e : a->eigenvalues) grows = grows || e.unstable;
    ASSERT_EQ(a->eigenvalues.size(), b->eigenvalues.size());
    for (std::size_t k = 0; k < a->eigenvalues.size(); ++k)
      EXPECT_EQ(a->eigenvalues[k].certified, b->eigenvalues[k].certified);
  }
  EXPECT_TRUE(grows) << "a case that shows little";
  for (std::size_t i = 0; i < metres.steady.solutions.size(); ++i) {
    const auto &a = metres.steady.solutions[i], &b = millimetres.steady.solutions[i];
    const double u = largestDisplacement(metres, i);
    EXPECT_GT(u, 0);
    EXPECT_NEAR(largestDisplacement(millimetres, i), 1e3 * u, 1e3 * u * asNear);
    EXPECT_EQ(a.openNodes, b.openNodes);
    EXPECT_NEAR(b.smallestPressure, 1e-6 * a.smallestPressure,
                1e-6 * std::abs(a.smallestPressure) * asNear);
  }
}

/// Young's modulus in GPa and density in kg/m³, as the options of a body in both systems.
std::string body(const std::string& name, double gigapascal, double density, bool inMillimetres) {
  return material(name, formatted("%g", gigapascal * (inMillimetres ? 1e3 : 1e9)), "0.28",
                  formatted("%g", density * (inMillimetres ? 1e-12 : 1.0)));
}

// Plane strain, periodic, with a prescribed displacement, and the direct method beside the reduced
// one.
TEST(Units, TwoLayers) {
  const auto run = [](bool inMillimetres, const std::string& more) {
    return runCase("two_layers",
                   "-mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 60 -flutter_friction 0.3,0.5 " +
                       body("disc", 10, 2000, inMillimetres) + body("pad", 4, 1200, inMillimetres) +
                       (inMillimetres ? "-mesh_scale 1000 -motion_disc_velocity 1000,0,0 "
                                        "-constraint_pad_top_displacement 0,-10,0 "
                                      : "") +
                       tight + more);
  };
  expectTheSame(run(false, ""), run(true, ""));
  const std::string direct = "-flutter_method direct -flutter_direct_count 20";
  expectTheSame(run(false, direct), run(true, direct));
}

// In space, with all terms of a rotating disc: convection, friction damping, a friction law,
// damping of materials, springs to the ground and the stiffness of the steady stress.
TEST(Units, RotatingDiscBrake) {
  const auto run = [](bool inMillimetres) {
    std::string options =
        "-mesh_set "
        "n_pad_theta=6,n_free_theta=9,n_mount=1,n_plate=1,n_wall=1,n_inside=1,n_pad_r=3,n_hat=2,n_"
        "h_plate=1,n_h_ring=2 -modes_count 40 -flutter_friction 0.4 -flutter_speed 1,10 "
        "-flutter_track off -elasticity_prestress on -friction_law exponential "
        "-friction_static_ratio 1.3 ";
    for (const auto& [name, modulus, density] : {std::tuple{"disc", 120.0, 7200.0},
                                                 {"hat", 120.0, 7200.0},
                                                 {"back_plate", 210.0, 7850.0},
                                                 {"lining", 1.5, 2500.0}})
      options += body(name, modulus, density, inMillimetres);
    options += "-material_disc_loss_factor 0.002 -material_disc_loss_frequency 4000 ";
    options += inMillimetres
                   ? "-mesh_scale 1000 -load_pressed_pressure 1 -friction_decay_speed 100 "
                     "-ground_guide_leading_stiffness 1e3,0,1e3 "
                     "-ground_guide_leading_damping 0.001,0,0 "
                   : "-load_pressed_pressure 1e6 -friction_decay_speed 0.1 "
                     "-ground_guide_leading_stiffness 1e6,0,1e6 "
                     "-ground_guide_leading_damping 1,0,0 ";
    return runCase("disc_brake_rotating", options + tight);
  };
  expectTheSame(run(false), run(true));
}

// A shape comes in millimetres: as it is with MPa and tonnes, or scaled to metres.
TEST(Units, ShapeInMillimetres) {
  const auto file = plateAndBlock("units.step");
  const auto run = [&](bool inMillimetres) {
    return runOptions(
        "-mesh_file " + file + " -mesh_size 8 -mesh_order 1 " +
        body("disc", 120, 7200, inMillimetres) + body("brake_pad", 2, 2500, inMillimetres) +
        "-constraint_bottom_clamped xyz -constraint_top_clamped xyz "
        "-contact_c_pad face_11 -contact_c_disc face_6 -modes_count 20 "
        "-flutter_friction 0.6 -motion_convective off -flutter_friction_damping off " +
        (inMillimetres ? "-constraint_top_displacement 0,0,-0.1 "
                         "-motion_disc_velocity 1000,0,0 "
                       : "-constraint_top_displacement 0,0,-0.0001 -mesh_scale 0.001 "
                         "-motion_disc_velocity 1,0,0 ") +
        tight);
  };
  expectTheSame(run(false), run(true));
}

}  // namespace
}  // namespace squeal::test
