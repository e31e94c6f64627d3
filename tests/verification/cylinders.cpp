// SPDX-License-Identifier: BSD-2-Clause
// Curved contact with a known pressure: two concentric cylinders, pressed together by pressure in
// the bore.
#include <gtest/gtest.h>

#include <cmath>

#include "exact/cylinders.hpp"
#include "model/contact/coupled.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using exact::cylinders::a;
using exact::cylinders::b;
using exact::cylinders::c;
using exact::cylinders::contactPressure;
using exact::cylinders::Cylinder;
using exact::cylinders::outer;

TEST(Cylinders, LameByHand) {
  // Against the textbook formula of equal materials: p = p0 · a²(c² − b²) / (b²(c² − a²)).
  const Cylinder in{1, 0.3, a, b}, out{1, 0.3, b, c};
  const double p =
      in.displacement(b, 1, 0) / (out.displacement(b, 1, 0) - in.displacement(b, 0, 1));
  EXPECT_NEAR(p, a * a * (c * c - b * b) / (b * b * (c * c - a * a)), 1e-14);
}

/// Relative errors: the largest of all contact nodes, and that of the mean pressure.
struct Deviation {
  double pressure = 0, displacement = 0, mean = 0;
};

/// `refinement` times as many cells in both directions as the coarsest mesh; `pad` and `disc` name
/// the sides of the contact.
Deviation solve(const std::string& shape, int refinement, const std::string& pad,
                const std::string& disc) {
  const auto times = [&](int cells) { return std::to_string(cells * refinement); };
  test::setOptions(
      "-mesh_file meshes/cylinders.geo -mesh_set n_inner=" + times(2) + ",n_outer=" + times(3) +
      ",n_theta=" + times(16) + shape + test::material("inner", "7e10", "0.33", "2700") +
      test::material("outer", "2.1e11", "0.3", "7850") +
      "-constraint_sym_x_clamped x -constraint_sym_y_clamped y -load_inner_bore_pressure 3e6"
      " -contact_ring_pad " +
      pad + "_face -contact_ring_disc " + disc + "_face");
  const auto model = test::buildModel();
  const contact::CoupledSystem system(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  const auto solution = steady::Problem(*model.mesh, model.bodies, model.contact).solve({}, system);
  EXPECT_TRUE(solution.converged) << solution.reason;
  EXPECT_EQ(solution.openNodes, 0);
  const double p = contactPressure(), u = outer.displacement(b, p, 0);
  const PetscScalar* values = nullptr;
  Deviation worst;
  double force = 0, length = 0;
  check(VecGetArrayRead(solution.displacement, &values));
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& node = model.contact.interfaces.nodes[i];
    const double r = std::hypot(node.position[0], node.position[1]);
    EXPECT_NEAR(r, b, 1e-10);
    const double radial =
        (values[2 * node.node] * node.position[0] + values[2 * node.node + 1] * node.position[1]) /
        r;
    force += solution.contact[i].normalForce, length += node.area;
    worst.pressure = test::worse(worst.pressure, std::abs(solution.contact[i].pressure / p - 1));
    worst.displacement = test::worse(worst.displacement, std::abs(radial / u - 1));
  }
  check(VecRestoreArrayRead(solution.displacement, &values));
  return {test::largest(worst.pressure), test::largest(worst.displacement),
          std::abs(test::total(force) / test::total(length) / p - 1)};
}

struct Orders {
  double pressure, displacement, mean;
};

void converges(const std::string& shape, const Orders& orders, const Deviation& finest,
               const std::string& pad = "inner", const std::string& disc = "outer") {
  std::vector<Deviation> errors;
  for (const int refinement : {1, 2, 4}) {
    errors.push_back(solve(shape, refinement, pad, disc));
    const auto& e = errors.back();
    test::print(
        "cylinders%s, pad %s, %dx: error of pressure %.2e, of its mean %.2e, of displacement "
        "%.2e\n",
        shape.c_str(), pad.c_str(), refinement, e.pressure, e.mean, e.displacement);
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {
    const auto &coarse = errors[i - 1], &fine = errors[i];
    EXPECT_GT(std::log2(coarse.pressure / fine.pressure), orders.pressure - 0.4);
    EXPECT_GT(std::log2(coarse.displacement / fine.displacement), orders.displacement - 0.4);
    EXPECT_GT(std::log2(coarse.mean / fine.mean), orders.mean - 0.4);
  }
  EXPECT_LT(errors.back().pressure, finest.pressure);
  EXPECT_LT(errors.back().displacement, finest.displacement);
  EXPECT_LT(errors.back().mean, finest.mean);
}

// Chords for arcs: all errors are of second order.
TEST(Cylinders, BilinearFaces) { converges("", {2, 2, 2}, {2e-3, 2e-3, 2e-3}); }
TEST(Cylinders, SidesMayBeExchanged) {
  converges("", {2, 2, 2}, {2e-3, 2e-3, 2e-3}, "outer", "inner");
}
// Parabolas for arcs. Nodal pressures at corners and at mid-side nodes err in opposite directions:
// their mean, and displacements, are better.
TEST(Cylinders, CurvedQuad9Faces) { converges(",order=2", {2, 3, 3}, {1e-3, 2e-5, 2e-5}); }
TEST(Cylinders, CurvedQuad8Faces) {
  converges(",order=2,serendipity=1", {2, 3, 3}, {1e-3, 2e-5, 2e-5});
}
TEST(Cylinders, CurvedTri6Faces) {
  converges(",order=2,recombine=0", {2, 3, 3}, {1e-2, 1e-4, 1e-4});
}

}  // namespace
}  // namespace squeal
