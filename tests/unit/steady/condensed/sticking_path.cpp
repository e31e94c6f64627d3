// SPDX-License-Identifier: BSD-2-Clause
// Where along a sweep the nodes of a sticking interface open and close.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "steady/condensed/contact_path.hpp"
#include "support/harness/largest_error.hpp"
#include "support/harness/ranks.hpp"
#include "support/steady/condensed_contact.hpp"

namespace squeal::test {
namespace {

// A tall block stands on a base to which it sticks; a plate slides on its top and tips it. Where
// the normal force of a node of the base vanishes, it is freed along the surface and its tangential
// force vanishes, so the state jumps: it remains closed at first and opens later. Between any two
// changes, the set of the path has no tensile force and no overlap, which the condensed equations
// of this set alone show.
TEST(ContactPath, StickingNodesAreFreedBeforeTheyOpen) {
  Condensed model(
      "-mesh_file meshes/two_layers.geo -mesh_set Lx=1,nx=8,ny_disc=4,ny_pad=8,h_pad=2 "
      "-elasticity_plane strain -material_disc_young 1e9 -material_disc_poisson 0.3 "
      "-material_disc_density 1000 -material_pad_young 1e9 -material_pad_poisson 0.3 "
      "-material_pad_density 1000 -constraint_disc_bottom_clamped xy -contact_base_pad pad_face "
      "-contact_base_disc disc_face -contact_base_role sticking -contact_plate_pad pad_top "
      "-contact_plate_obstacle_velocity 1,0,0 -contact_plate_obstacle_displacement 0,-0.001,0");
  condensed::CondensedProblem whole(model.problem, model.closed);
  const auto first = whole.solve({0});
  ASSERT_TRUE(first.converged);
  const sweep::Parameters end{.friction = 0.3};
  const auto path = condensed::traceContact(whole, first, end);
  EXPECT_EQ(path.obstacle, "");
  std::vector<double> own;
  int atSticking = 0, unheld = 0;
  for (const auto& event : path.events) {
    own.push_back(event.at.friction);
    const auto role = model.model.contact.interfaces.nodes[event.node].role;
    atSticking += role == contact::Role::sticking;
    unheld += event.change == condensed::Change::unheld;
    EXPECT_EQ(event.isReleased, role == contact::Role::sticking &&
                                    event.change != condensed::Change::closes &&
                                    event.change != condensed::Change::held)
        << condensed::text(event.change);
  }
  std::vector<double> frictions = concatenated(PETSC_COMM_WORLD, own);
  std::ranges::sort(frictions);
  frictions.erase(std::ranges::unique(frictions).begin(), frictions.end());
  condensed::ChosenSet set{{}, first.closed, first.sticking};
  double unit = 0;
  for (const auto& state : first.contact) unit = std::max(unit, state.normalForce);
  unit = largest(unit);
  for (std::size_t k = 0; k < frictions.size(); ++k) {
    for (const auto& event : path.events)
      if (event.at.friction == frictions[k]) {
        set.closed[event.node] = event.change != condensed::Change::opens;
        set.sticking.holds[event.node] = event.isReleased ? steady::Hold::open : steady::Hold::held;
      }
    set.at.friction =
        (frictions[k] + (k + 1 < frictions.size() ? frictions[k + 1] : end.friction)) / 2;
    const auto state = whole.onSet(set);
    double worst = 0;
    for (std::size_t i = 0; i < set.closed.size(); ++i) {
      const std::size_t j = set.closed.size() + i;
      worst = worse(
          worst,
          -(set.closed[i] ? state.effects[j] : whole.gapStiffness(i) * state.causes[j]) / unit);
    }
    // The path is followed to 1e-9 of the largest force.
    EXPECT_LE(largest(worst), 1e-9) << set.at.friction;
  }
  print("%d changes at %zu frictions, %g of sticking nodes, %g unheld\n", path.count,
        frictions.size(), double(mpi::sum(PETSC_COMM_WORLD, atSticking)),
        double(mpi::sum(PETSC_COMM_WORLD, unheld)));
  EXPECT_EQ(mpi::sum(PETSC_COMM_WORLD, atSticking), 4);  // two nodes, each freed and opened
  EXPECT_EQ(mpi::sum(PETSC_COMM_WORLD, unheld), 2);
}

}  // namespace
}  // namespace squeal::test
