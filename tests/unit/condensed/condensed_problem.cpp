// Steady sliding in the unknowns of the contact against the same in all unknowns, and what a sweep
// of it costs.
#include "condensed/condensed_problem.hpp"

#include <gtest/gtest.h>

#include <string>

#include "contact/coupled.hpp"
#include "support/case.hpp"
#include "support/model.hpp"
#include "support/steel_brake.hpp"
#include "support/worst.hpp"

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

/// Collective. Solves at all points in both forms, and expects the same.
Largest compare(const std::string& name, const std::string& options,
                const std::vector<sweep::Parameters>& points) {
  setOptions(options);
  const auto model = buildModel();
  EXPECT_TRUE(condensed::CondensedProblem::serves(model.contact, model.bodies));
  const contact::CoupledSystem closed(model.bodies, model.contact,
                                      std::vector<unsigned char>(model.contact.nodes.size(), 1));
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  condensed::CondensedProblem condensed(problem, closed);
  Largest all;
  for (const auto& at : points) {
    const auto full = problem.solve(at, closed), small = condensed.solve(at);
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
    // Both are solved to 1e-11 of the loads; a gap is soft by some ten times that.
    EXPECT_LT(largest(one.forceError), 1e-9 * one.force);
    EXPECT_LT(largest(one.gapError), 1e-9 * one.gap + 1e-12);
    all.open = std::max(all.open, one.open);
    all.forceError = worse(all.forceError, largest(one.forceError) / one.force);
    all.gapError = worse(all.gapError, one.gap > 0 ? largest(one.gapError) / one.gap : 0);
  }
  // The matrix Z of causes and effects has two columns a node where nothing sticks, each of which
  // is solved for once. Further solves are for the loads and for the corrections at each point.
  const int tangents = model.contact.hasSticking() ? model.mesh->dimension - 1 : 0;
  EXPECT_LE(condensed.solves(),
            (2 + tangents) * model.contact.totalNodes + 12 * std::ssize(points) + 3);
  print("%s: forces to %.1e, gaps to %.1e, up to %d open; %ld solves\n", name.c_str(),
        all.forceError, all.gapError, static_cast<int>(all.open), condensed.solves());
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

TEST(CondensedProblem, PadsHeldBySprings) {
  compare("steel brake", steel_brake::options(1, 0.022, 1e5), {{0}, {0.25}, {0.5}});
}

}  // namespace
}  // namespace squeal::test
