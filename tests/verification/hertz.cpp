// SPDX-License-Identifier: BSD-2-Clause
// Hertz contact of a cylinder and of a sphere on a block, whose meshes do not match and which have
// a gap between them without load: half width and pressure.
#include <gtest/gtest.h>

#include <cmath>

#include "model/contact/coupled.hpp"
#include "steady/condensed/condensed_problem.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

// Lengths in mm, forces in N, moduli and pressures in MPa. Source of the formulae: K.L. Johnson,
// Contact Mechanics, chapter 4.
constexpr double radius = 50, poisson = 0.3, steel = 210000, aluminium = 70000;

/// 1/E* = (1 − ν²)/E1 + (1 − ν²)/E2
double effective(double one, double two) {
  return 1 / ((1 - poisson * poisson) * (1 / one + 1 / two));
}

struct Hertz {
  double size = 0, pressure = 0;  ///< a and p0
};

/// A force per length: a² = 4 F R / (π E*), p0 = 2 F / (π a).
Hertz cylinder(double force, double modulus) {
  const double a = std::sqrt(4 * force * radius / (M_PI * modulus));
  return {a, 2 * force / (M_PI * a)};
}
/// a³ = 3 F R / (4 E*), p0 = 3 F / (2 π a²).
Hertz sphere(double force, double modulus) {
  const double a = std::cbrt(3 * force * radius / (4 * modulus));
  return {a, 3 * force / (2 * M_PI * a * a)};
}

std::string pressed(const std::string& mesh, double young, double pressure,
                    const std::string& options) {
  return "-mesh_file meshes/hertz.geo -mesh_set " + mesh + material("round", "210000", "0.3", "1") +
         material("block", std::to_string(young), "0.3", "1") +
         "-constraint_middle_clamped x -load_pressed_pressure " + std::to_string(pressure) +
         " -contact_c_pad block_face -contact_c_disc round_face -contact_c_gap measured"
         " -contact_c_search 3 -contact_c_role frictionless " +
         options;
}

/// The contact found: its force, its size a, its largest pressure, and the furthest closed node.
struct Found {
  double force = 0, size = 0, pressure = 0, last = 0;
};

/// `share` is that of a² in the mean square of the distance from the middle: 1/4 of a cylinder, 2/5
/// of a sphere, whose pressures are p0 √(1 − r²/a²).
Found solve(const std::string& options, double share, bool isSphere) {
  setOptions(options);
  const auto model = buildModel();
  EXPECT_FALSE(model.contact.interfaces.reports.at(0).matching);
  const contact::CoupledSystem system(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const auto solution = condensed::CondensedProblem(problem, system).solve({});
  EXPECT_TRUE(solution.converged) << solution.reason;
  EXPECT_GT(solution.openNodes, 0);
  Found found;
  double square = 0;
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& x = model.contact.interfaces.nodes[i].position;
    const auto& state = solution.contact[i];
    const double r = std::hypot(x[0], isSphere ? x[2] : 0);
    found.force += state.normalForce, square += r * r * state.normalForce;
    found.pressure = worse(found.pressure, state.pressure);
    if (solution.closed[i]) found.last = worse(found.last, r);
  }
  found.force = total(found.force), found.size = std::sqrt(total(square) / found.force / share);
  found.pressure = largest(found.pressure), found.last = largest(found.last);
  print("force %.2f, a %.4f, furthest closed node %.3f, p0 %.1f; %d of %d nodes open\n",
        found.force, found.size, found.last, found.pressure, static_cast<int>(solution.openNodes),
        static_cast<int>(model.contact.interfaces.totalNodes));
  return found;
}

/// Checks size and pressure within a part of them, and the furthest closed node within a cell.
void expectHertz(const Found& found, const Hertz& exact, double tolerance, double cell) {
  EXPECT_NEAR(found.size / exact.size, 1, tolerance);
  EXPECT_NEAR(found.pressure / exact.pressure, 1, tolerance);
  EXPECT_NEAR(found.last, exact.size, cell);
}

const double lineForce = 35000;  // per length, as in the benchmark of NAFEMS

Found onBlock(const std::string& mesh, const std::string& options) {
  return solve(pressed(mesh, aluminium, lineForce / (2 * radius), options), 0.25, false);
}

// The half space of the theory is a block of two radii here, and the parabola is a circle:
// differences of 0.3 % remain.
TEST(Hertz, CylinderInThePlane) {
  const Hertz exact = cylinder(lineForce, effective(steel, aluminium));
  EXPECT_NEAR(exact.size, 6.21, 0.005);
  EXPECT_NEAR(exact.pressure, 3585, 0.5);
  for (const std::string mesh : {"h=0.5", "order=2,h=1", "order=2,recombine=1,h=1"}) {
    const Found found = onBlock(mesh, "-constraint_bottom_clamped xy");
    EXPECT_NEAR(found.force / (lineForce / 2), 1, 1e-8);
    expectHertz(found, exact, 0.005, 1);
  }
  expectHertz(onBlock("order=2,h=0.7", "-constraint_bottom_clamped xy -contact_c_slave disc"),
              exact, 0.005, 1);
}

// Faces tri6, quad9 and quad8.
TEST(Hertz, CylinderAsSlab) {
  const Hertz exact = cylinder(lineForce, effective(steel, aluminium));
  for (const std::string cells : {"", ",recombine=1", ",recombine=1,serendipity=1"}) {
    const Found found = onBlock("body=1,order=2,h=1" + cells,
                                "-constraint_bottom_clamped xyz -constraint_round_clamped z"
                                " -constraint_block_clamped z");
    EXPECT_NEAR(found.force / lineForce, 1, 1e-8);  // 2 mm of the half
    expectHertz(found, exact, 0.005, 1);
  }
}

// A quarter of a sphere. Its surface and the pressed one are meshed by triangles: faces tri6.
TEST(Hertz, Sphere) {
  const double load = 80;
  const Hertz exact = sphere(load * M_PI * radius * radius, effective(steel, steel));
  std::vector<double> error;
  for (const double h : {2.0, 1.4}) {
    const Found found = solve(pressed("body=2,order=2,h=" + std::to_string(h), steel, load,
                                      "-constraint_bottom_clamped xyz -constraint_front_clamped z"),
                              0.4, true);
    EXPECT_NEAR(found.force / (load * M_PI * radius * radius / 4), 1, 3e-4);
    expectHertz(found, exact, 0.006 * h, h);
    error.push_back(std::abs(found.size / exact.size - 1));
  }
  EXPECT_LT(error[1], error[0] / 2);
}

// The same with faces quad9 and quad8: gmsh makes four hexahedra of each tetrahedron, with half its
// edges.
TEST(Hertz, SphereOfHexahedra) {
  const double load = 80;
  const Hertz exact = sphere(load * M_PI * radius * radius, effective(steel, steel));
  for (const std::string cells : {"", ",serendipity=1"}) {
    std::vector<double> error;
    for (const double h : {4.0, 2.8}) {
      const Found found =
          solve(pressed("body=2,order=2,recombine=1,h=" + std::to_string(h) + cells, steel, load,
                        "-constraint_bottom_clamped xyz -constraint_front_clamped z"),
                0.4, true);
      EXPECT_NEAR(found.force / (load * M_PI * radius * radius / 4), 1, 3e-4);
      EXPECT_NEAR(found.size / exact.size, 1, 0.003 * h);
      // Nodal pressures of quad8 scatter by some percent on cells as distorted as these.
      EXPECT_NEAR(found.pressure / exact.pressure, 1, cells.empty() ? 0.003 * h : 0.02);
      EXPECT_NEAR(found.last, exact.size, h / 2);
      error.push_back(std::abs(found.size / exact.size - 1));
    }
    EXPECT_LT(error[1], error[0]);
  }
}

}  // namespace
}  // namespace squeal::test
