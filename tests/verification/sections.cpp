// SPDX-License-Identifier: BSD-2-Clause
// Bodies made up of sections: a laminate with turned axes against the springs in series that its
// plies are, rings with cylindrical axes against Lekhnitskii's solution, a turned laminate, and a
// brake whose pad and rotor have two sections each.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/petsc/arrays.hpp"
#include "base/system/text.hpp"
#include "eigen/modes/modes.hpp"
#include "exact/orthotropic.hpp"
#include "exact/orthotropic_rings.hpp"
#include "model/contact/coupled.hpp"
#include "model/frame/frame.hpp"
#include "steady/steady/steady.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using mesh::Matrix3;
using mesh::Point;

/// Collective. Returns the steady displacement of the model of the options in force.
OwnedVec solved(const test::Model& model) {
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  auto solution = steady::Problem(*model.mesh, model.bodies, model.contact).solve({}, system);
  EXPECT_TRUE(solution.converged) << solution.reason;
  return std::move(solution.displacement);
}

const std::string first = exact::orthotropic::constants,
                  second = "2,0.5,1.1,0.1,0.3,0.25,0.4,0.6,0.3";

/// A laminate with an orthotropic ply in turned axes below and another one above.
std::string laminate(const std::string& lowerAxes, const std::string& upperAxes) {
  return " -material_plate_sections lower,upper -material_plate_density 1.7 "
         "-material_upper_density 0.9 "
         "-material_lower_engineering_constants " +
         first + " -material_upper_engineering_constants " + second + " " + lowerAxes + upperAxes;
}

/// Returns the components A_ij of the law between the strains and stresses of planes z = constant,
/// with u = u(z): σ_iz = A_ij u_j′.
Matrix3 acrossZ(const std::string& constants, const Point& x, const Point& xy) {
  std::vector<double> c;
  for (const auto& word : split(constants, ',')) c.push_back(std::stod(word));
  const Point one = mesh::unit(x), three = mesh::unit(mesh::cross(x, xy));
  const auto law = material::rotated(
      material::orthotropic({c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]}),
      {one, mesh::cross(three, one), three});
  const int rows[] = {5, 4, 2};  // zx, yz, zz
  Matrix3 a{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) a[i][j] = law(rows[i], rows[j]);
  return a;
}

// A column that is periodic in x and y: u depends on z only, and the plies are springs in series,
//   u(h1 + h2) = (h1 A1⁻¹ + h2 A2⁻¹) t
// for the traction t on the top. The axes couple all components. The displacement is linear in each
// ply, which all cells represent, and the tolerance is that of the solution of a linear system.
TEST(Sections, PliesInSeries) {
  const Matrix3 lower = acrossZ(first, {1, 0.5, 0.2}, {-0.3, 1, 0.4}),
                upper = acrossZ(second, {0.2, -1, 0.6}, {1, 0.1, 0.3}),
                softLower = mesh::inverse(lower, mesh::determinant(lower)),
                softUpper = mesh::inverse(upper, mesh::determinant(upper));
  const Point traction{0.03, -0.02, -0.05};
  Point expected[2] = {};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      expected[0][i] += 0.3 * softLower[i][j] * traction[j];
      expected[1][i] += (0.3 * softLower[i][j] + 0.5 * softUpper[i][j]) * traction[j];
    }
  const std::string axes = laminate("-material_lower_orientation 1,0.5,0.2,-0.3,1,0.4 ",
                                    "-material_upper_frame f -frame_f_x 0.2,-1,0.6 "
                                    "-frame_f_xy 1,0.1,0.3 ");
  // The force on the top is shared equally by its nodes, which are not the consistent forces: only
  // the mean over a period is exact. With one cell along x and y all nodes of a level are images of
  // one node, or of one corner and three nodes between, so linear cells have the exact solution.
  for (const char* set : {"", ",recombine=0", ",recombine=0,wedge=1"}) {
    test::setOptions(std::string("-mesh_file meshes/laminate.geo -mesh_set nx=1,ny=1") + set +
                     axes +
                     "-constraint_bottom_clamped xyz -constraint_right_image_of left "
                     "-constraint_back_image_of front " +
                     formatted("-load_top_force %.17g,%.17g,%.17g ", 0.8 * traction[0],
                               0.8 * traction[1], 0.8 * traction[2]));
    const auto model = test::buildModel();
    const OwnedVec u = solved(model);
    const ReadArray values(u);
    for (PetscInt node = 0; node < model.mesh->ownedNodes; ++node) {
      const double z = model.mesh->coordinates[node][2];
      const int level = std::abs(z - 0.3) < 1e-9 ? 0 : std::abs(z - 0.8) < 1e-9 ? 1 : -1;
      for (int d = 0; level >= 0 && d < 3; ++d)
        EXPECT_NEAR(values[3 * node + d], expected[level][d], 1e-11 * mesh::length(expected[1]))
            << set << " z = " << z;
    }
  }
}

/// Largest relative error of the radial displacement at the nodes of two bonded rings.
double ringError(const std::string& cells, int refinement) {
  const auto times = [&](int count) { return std::to_string(count * refinement); };
  using namespace exact::orthotropic;
  const double e[] = {2e10, 9e10, 3e10}, nu[] = {0.1, 0.2, 0.25};
  test::setOptions(
      "-mesh_file meshes/cylinders.geo -mesh_set shared=1,n_inner=" + times(2) +
      ",n_outer=" + times(3) + ",n_theta=" + times(16) + cells +
      " -material_ring_sections inner,outer -material_ring_density 1 -frame_axis_axis 0,0,1 " +
      "-material_ring_frame axis -material_inner_engineering_constants 3e10,1.3e10,0.8e10,0.35,"
      "0.42,0.27,1e10,1e10,1e10 -material_outer_cylindrical 0,0,0,0,0,1 " +
      formatted("-material_outer_engineering_constants %g,%g,%g,%g,%g,%g,1e10,1e10,1e10 ", e[0],
                e[1], e[2], nu[0], nu[1], nu[2]) +
      "-constraint_sym_x_clamped x -constraint_sym_y_clamped y -load_inner_bore_pressure 3e6");
  const auto model = test::buildModel();
  const OwnedVec u = solved(model);
  const auto [d11, d22, d12] = planeStrain();
  const auto outer = material::orthotropic({e[0], e[1], e[2], nu[0], nu[1], nu[2], 1, 1, 1});
  const exact::orthotropic_rings::Solution exact({1e10 * d11, 1e10 * d22, 1e10 * d12},
                                                 {outer(0, 0), outer(1, 1), outer(0, 1)},
                                                 {0.05, 0.08, 0.12}, 3e6);
  const ReadArray values(u);
  double worst = 0;
  for (PetscInt node = 0; node < model.mesh->ownedNodes; ++node) {
    const Point& x = model.mesh->coordinates[node];
    const double r = std::hypot(x[0], x[1]),
                 radial = (values[2 * node] * x[0] + values[2 * node + 1] * x[1]) / r;
    worst = test::worse(worst, std::abs(radial / exact.displacement(r) - 1));
  }
  return test::largest(worst);
}

// Exponents of 0.7 and 2.1. Chords for arcs: second order; parabolas with quadratic cells: third.
TEST(Sections, OrthotropicRingsUnderPressure) {
  for (const auto& [cells, order, finest] : {std::tuple{"", 2.0, 1e-2},
                                             {",order=2,serendipity=1", 3.0, 1e-4},
                                             {",order=2,recombine=0", 3.0, 2e-4}}) {
    double before = 0;
    for (const int refinement : {1, 2, 4}) {
      const double error = ringError(cells, refinement);
      test::print("rings%s, %dx: error of displacement %.2e\n", cells, refinement, error);
      if (before > 0) {
        EXPECT_GT(std::log2(before / error), order - 0.4) << cells;
      }
      before = error;
    }
    EXPECT_LT(before, finest) << cells;
  }
}

/// Collective. Returns the lowest frequencies of a clamped laminate that is turned by an angle
/// about (1, 2, 2), with its axes, and on a ground spring in a frame.
std::vector<double> turnedFrequencies(double degrees, const std::string& cells) {
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  const auto turned = [&](const Point& x) {
    const Point n{1.0 / 3, 2.0 / 3, 2.0 / 3};
    const Point y = mesh::plus(mesh::plus(mesh::scaled(x, c), mesh::cross(n, x), s), n,
                               (1 - c) * mesh::dot(n, x));
    return formatted("%.17g,%.17g,%.17g ", y[0], y[1], y[2]);
  };
  test::setOptions(
      "-mesh_file meshes/laminate.geo -mesh_set turn=" + formatted("%.17g", degrees) + cells +
      laminate("-material_lower_frame f -frame_f_x " + turned({1, 0.4, 0.1}) + "-frame_f_xy " +
                   turned({0, 1, 0.2}),
               "-material_upper_frame c -frame_c_axis " + turned({0.1, 0.2, 1}) +
                   "-frame_c_origin " + turned({-0.7, 0.3, 0})) +
      "-constraint_left_clamped xyz -ground_top_stiffness 0.1,0.4,0 -ground_top_frame g "
      "-frame_g_x " +
      turned({0.5, 1, 0.3}) + "-frame_g_xy " + turned({1, 0, 0}) + "-modes_count 6");
  const auto model = test::buildModel();
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  auto found = modes::compute(system, modes::Settings::given()).angularFrequency;
  found.resize(6);
  return found;
}

// The same brake in other axes has the same frequencies; eigenvalues are solved to 1e-10.
TEST(Sections, FrequenciesOfATurnedLaminate) {
  for (const char* cells : {"", ",order=2,serendipity=1", ",recombine=0,order=2",
                            ",recombine=0,wedge=1,order=2,serendipity=1"}) {
    const auto straight = turnedFrequencies(0, cells), turned = turnedFrequencies(77, cells);
    for (std::size_t i = 0; i < straight.size(); ++i)
      EXPECT_NEAR(turned[i] / straight[i], 1, 1e-9) << cells << i;
  }
}

/// The coarse disc brake with all that a material enters: damping, prestress, weight, friction
/// damping and derivatives of eigenvalues. The lining is orthotropic in a cylindrical frame.
std::string brake(const std::string& bodies) {
  return "-mesh_file meshes/disc_brake.geo -mesh_set order=2,serendipity=1,n_pad_theta=2,n_pad_r=2,"
         "n_free_theta=4 -frame_wheel_axis 0,0,1 "
         "-material_lining_engineering_constants 2e9,3e9,1.5e9,0.2,0.1,0.15,1e9,0.8e9,0.7e9 "
         "-material_lining_frame wheel -material_lining_density 2500 "
         "-material_lining_rayleigh_stiffness 1e-7 -material_lining_integration reduced "
         "-material_back_plate_young 2.1e11 -material_back_plate_poisson 0.3 "
         "-material_back_plate_density 7850 -material_hat_rayleigh_mass 20 "
         "-constraint_mounting_clamped xyz -constraint_guide_trailing_clamped y "
         "-constraint_guide_leading_clamped y -constraint_guide_radial_clamped x "
         "-load_pressed_pressure 1e6 -load_gravity 0,0,-9.81 -elasticity_prestress on "
         "-contact_pad_pad lining_face -contact_pad_disc disc_face -friction_law exponential "
         "-friction_static_ratio 1.5 -friction_decay_speed 1 "
         "-modes_count 24 -flutter_friction 0.3 -flutter_band 5000 -flutter_sensitivities " +
         bodies;
}

/// Returns the derivatives of the eigenvalue at a point of the sweep that is nearest to s.
std::map<std::string, Complex> derivativesAt(const pencil::ComplexModes& point, Complex s) {
  std::size_t nearest = 0;
  const auto distance = [&](std::size_t i) {
    return std::abs(point.eigenvalues[point.shapes[i].index].s - s);
  };
  for (std::size_t i = 1; i < point.shapes.size(); ++i)
    if (distance(i) < distance(nearest)) nearest = i;
  std::map<std::string, Complex> derivatives;
  for (const auto& derivative : point.sensitivities.at(nearest).derivatives)
    derivatives[derivative.parameter] = derivative.value;
  return derivatives;
}

// A pad of lining and back plate and a rotor of ring and hat, as bodies of two sections each: the
// same brake as four bodies that share nodes, with the nodes in another order. The eigenvalues are
// solved to a backward error of 1e-9, and the derivatives, which have the names of the sections,
// are as accurate as their eigenvectors.
TEST(Sections, BrakeOfBodiesWithSections) {
  const std::string iron = "_young 1.2e11 -material_", rest = "_poisson 0.25 -material_";
  std::string ring, apart;
  for (const std::string body : {"disc", "hat"})
    apart += "-material_" + body + iron + body + rest + body + "_density 7200 -motion_" + body +
             "_speed 5 ";
  ring = "-material_rotor" + iron + "rotor" + rest +
         "rotor_density 7200 -motion_rotor_speed 5 "
         "-material_rotor_sections disc,hat -material_pad_sections lining,back_plate ";
  const auto one = test::runOptions(brake(apart)), other = test::runOptions(brake(ring));
  EXPECT_EQ(other.model.mesh->bodies, (std::vector<std::string>{"pad", "rotor"}));
  const auto &wanted = one.flutter.segments.at(0).points.at(0),
             &found = other.flutter.segments.at(0).points.at(0);
  ASSERT_EQ(found.eigenvalues.size(), wanted.eigenvalues.size());
  ASSERT_GE(wanted.shapes.size(), 1u);
  const auto matched = test::matched(test::eigenvaluesOf(wanted), test::eigenvaluesOf(found));
  for (std::size_t i = 0; i < matched.size(); ++i)
    EXPECT_LT(std::abs(matched[i] - wanted.eigenvalues[i].s), 1e-7 * std::abs(matched[i])) << i;
  for (const auto& shape : wanted.shapes) {
    const Complex s = wanted.eigenvalues[shape.index].s;
    const auto mine = derivativesAt(found, s);
    const auto theirs = derivativesAt(wanted, s);
    ASSERT_EQ(mine.size(), theirs.size());
    for (const auto& [name, value] : theirs)
      EXPECT_LT(std::abs(mine.at(name) - value), 1e-6 * std::abs(s)) << name;
  }
}

}  // namespace
}  // namespace squeal
