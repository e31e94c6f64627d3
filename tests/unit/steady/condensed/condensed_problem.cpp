// SPDX-License-Identifier: BSD-2-Clause
// Steady sliding in the unknowns of the contact against the same in all unknowns, and what a sweep
// of it costs.
#include "steady/condensed/condensed_problem.hpp"

#include <gtest/gtest.h>

#include <string>

#include "model/contact/coupled.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/model/steel_brake.hpp"
#include "support/run/case.hpp"
#include "support/steady/strained_slider.hpp"

namespace squeal::test {
namespace {

// A pad that friction drags over a disc; its trailing end opens from f = 1/(6 · 0.8) on. Plane
// strain of second order, as a slab for solid cells.
const std::string dragged =
    " -motion_disc_velocity 1,0,0 -constraint_disc_bottom_clamped xy"
    " -constraint_pad_top_clamped x -load_pad_top_pressure 0.01"
    " -contact_interface_pad pad_face -contact_interface_disc disc_face" +
    material("disc", "1", "0.3", "1") + material("pad", "0.4", "0.25", "0.6");

std::string slab(const std::string& cells) {
  return "-mesh_file meshes/two_slabs.geo -constraint_disc_clamped z -constraint_pad_clamped z"
         " -mesh_set Lx=1,h_disc=0.5,h_pad=0.8,order=2,nx=6,ny_disc=3,ny_pad=4," +
         cells + dragged;
}

struct Largest {
  double gap = 0, force = 0, gapError = 0, forceError = 0;
  PetscInt open = 0;
};

/// Collective. Expects a solution in all unknowns and one in those of the contact to be the same.
Largest compare(const steady::Solution& full, const steady::Solution& small) {
  EXPECT_TRUE(full.converged) << full.reason;
  EXPECT_TRUE(small.converged) << small.reason;
  EXPECT_EQ(full.openNodes, small.openNodes);
  EXPECT_EQ(full.closed, small.closed);
  EXPECT_LT(small.imbalance, 1e-10);
  Largest one{0, 0, 0, 0, small.openNodes};
  for (std::size_t i = 0; i < full.contact.size(); ++i) {
    const auto &a = full.contact[i], &b = small.contact[i];
    one.gap = worse(one.gap, std::abs(a.gap)), one.force = worse(one.force, a.normalForce);
    one.gapError = worse(one.gapError, std::abs(a.gap - b.gap));
    one.forceError = worse(one.forceError, std::abs(a.normalForce - b.normalForce));
  }
  one.gap = largest(one.gap), one.force = largest(one.force);
  one.gapError = largest(one.gapError), one.forceError = largest(one.forceError);
  // Both are solved to 1e-11 of the loads; a gap is soft by some ten times that.
  EXPECT_LT(one.forceError, 1e-9 * one.force);
  EXPECT_LT(one.gapError, 1e-9 * one.gap + 1e-12);
  return {0, 0, one.gap > 0 ? one.gapError / one.gap : 0, one.forceError / one.force, one.open};
}

/// Collective. Solves at all points in both forms, one by one and together, and expects the same.
Largest compare(const std::string& name, const std::string& options,
                const std::vector<sweep::Parameters>& points) {
  setOptions(options);
  const auto model = buildModel();
  const bool isExact = condensed::CondensedProblem::isExact(model.contact, model.bodies);
  EXPECT_EQ(isExact, !model.contact.sliding.convected);
  const contact::CoupledSystem closed(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  condensed::CondensedProblem single(problem, closed), together(problem, closed);
  const auto atOnce = together.solveTogether(points);
  Largest all;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto full = problem.solve(points[k], closed), one = single.solve(points[k]);
    for (const auto* small : {&one, &atOnce[k]}) {
      const Largest errors = compare(full, *small);
      all.open = std::max(all.open, errors.open);
      all.forceError = worse(all.forceError, errors.forceError);
      all.gapError = worse(all.gapError, errors.gapError);
    }
  }
  // The matrix Z of causes and effects has two columns a node where nothing sticks, each of which
  // is solved for once. Further solves are for the loads and for the corrections at each point.
  const int tangents = model.contact.hasSticking() ? model.mesh->dimension - 1 : 0;
  for (const auto* condensed : {&single, &together}) {
    if (!isExact) continue;
    EXPECT_LE(condensed->solves(),
              (2 + tangents) * model.contact.interfaces.totalNodes + 12 * std::ssize(points) + 3);
  }
  print("%s: forces to %.1e, gaps to %.1e, up to %d open; %ld solves, %ld together\n", name.c_str(),
        all.forceError, all.gapError, static_cast<int>(all.open), single.solves(),
        together.solves());
  return all;
}

const std::vector<sweep::Parameters> frictions{{0}, {0.15}, {0.25}, {0.35}, {0.1}};

TEST(CondensedProblem, OpeningOnMatchingDisc) {
  EXPECT_GT(compare("hex27", slab("shape=1"), frictions).open, 0);
}

// The gaps of the pad's edges count in a basis of their own.
TEST(CondensedProblem, OpeningOnDiscMeshedApart) {
  EXPECT_GT(compare("tet10", slab("shape=0,nx_pad=9,nz_pad=2"), frictions).open, 0);
  EXPECT_GT(
      compare("hex20, disc is slave",
              slab("shape=1,serendipity=1,nx_pad=9,nz_pad=2") + " -contact_interface_slave disc",
              frictions)
          .open,
      0);
}

// Pressures and centrifugal forces enter in different powers of speed and pressure.
TEST(CondensedProblem, SweepsOfPressureAndSpeed) {
  compare("steel brake", steel_brake::options(1, 0.022, 1e5) + " -load_centrifugal on",
          {{0.2, 1, 1}, {0.2, 1, 2}, {0.2, 30, 2}, {0.3, 30, 0.5}});
}

// Friction follows the speed, and the slip the strain of the disc: corrections bring that in.
TEST(CondensedProblem, ConvectiveTermsAndAFrictionLaw) {
  compare("slider", slider::options(1, 0.6), {{0.1, 1}, {0.4, 1}, {0.2, 3}});
}

// All frictions of one active set are solved for in the Krylov space of the largest: (1 − f Z) t =
// b differs from one friction to another by a factor and a shift.
TEST(CondensedProblem, FrictionsOfAClosedContactShareASpace) {
  setOptions(steel_brake::options(1, 0.022, 1e7));
  const auto model = buildModel();
  const contact::CoupledSystem closed(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  condensed::CondensedProblem single(problem, closed), together(problem, closed);
  std::vector<sweep::Parameters> points;
  for (int k = 1; k <= 12; ++k) points.push_back({0.01 * k});
  EXPECT_EQ(single.solve(points.back()).openNodes, 0);
  for (const auto& solution : together.solveTogether(points)) EXPECT_EQ(solution.openNodes, 0);
  // Each point has a solve for its displacements. Friction is balanced to a part of its own size,
  // which may take the others one step more.
  print("%ld solves for the largest friction, %ld for 12 of them\n", single.solves(),
        together.solves());
  EXPECT_LE(together.solves(), single.solves() + 11 + 1);
}

TEST(CondensedProblem, PadsHeldBySprings) {
  compare("steel brake", steel_brake::options(1, 0.022, 1e5), {{0}, {0.25}, {0.5}});
}

}  // namespace
}  // namespace squeal::test
