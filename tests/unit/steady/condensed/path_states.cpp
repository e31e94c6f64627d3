// SPDX-License-Identifier: BSD-2-Clause
// States on many active sets, combined and interpolated, against those computed one by one.
#include "steady/condensed/path_states.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "support/harness/largest_error.hpp"
#include "support/harness/ranks.hpp"
#include "support/steady/condensed_contact.hpp"

namespace squeal::test {
namespace {

/// The largest difference of the forces and of the gaps of two states, relative to the largest of
/// each, on all ranks.
double difference(const impedance::ContactSolution& a, const impedance::ContactSolution& b,
                  std::size_t nodes) {
  double worst = 0;
  for (const auto part :
       {&impedance::ContactSolution::causes, &impedance::ContactSolution::effects}) {
    double change = 0, size = 0;
    for (std::size_t i = nodes; i < 2 * nodes; ++i) {
      change = worse(change, std::abs((a.*part)[i] - (b.*part)[i]));
      size = std::max(size, std::abs((b.*part)[i]));
    }
    worst = worse(worst, largest(change) / largest(size));
  }
  return worst;
}

/// Changes a few nodes, the same ones on any number of ranks. Those of sticking interfaces are
/// freed along the surface when they open, and some also while they are closed.
void change(condensed::ChosenSet& set, const contact::Contact& contact, unsigned draw) {
  const auto& nodes = contact.interfaces.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::mt19937 random(draw * 10007 + std::lround(1000 * (nodes[i].position[0] + 1)) +
                        std::lround(100 * nodes[i].position[1]) * 5003);
    const unsigned kind = random() % 8;
    if (kind < 2) set.closed[i] = !set.closed[i];
    if (nodes[i].role == contact::Role::sticking)
      set.sticking.holds[i] = set.closed[i] && kind != 7 ? steady::Hold::held : steady::Hold::open;
  }
}

struct Way {
  std::string options;
  sweep::Parameters to;
};

const std::string stack =
    "-mesh_file meshes/two_layers.geo -mesh_set Lx=1,nx=8,ny_disc=4,ny_pad=8,h_pad=2 "
    "-elasticity_plane strain -material_disc_young 1e9 -material_disc_poisson 0.3 "
    "-material_disc_density 1000 -material_pad_young 1e9 -material_pad_poisson 0.3 "
    "-material_pad_density 1000 -constraint_disc_bottom_clamped xy -contact_base_pad pad_face "
    "-contact_base_disc disc_face -contact_plate_pad pad_top "
    "-contact_plate_obstacle_velocity 1,0,0 -contact_plate_obstacle_displacement 0,-0.001,0 ";

// The unbalanced friction of an interpolated state is at most 3e-12 of its friction. The response
// of forces and gaps to it is at most some ten times as large here.
TEST(PathStates, SetsThatDifferInAFewNodes) {
  const std::vector<Way> ways{
      {stack + "-contact_base_role sticking", {.friction = 0.3}},
      {stack + "-contact_base_role frictionless -ground_pad_stiffness 1e8,0,0", {.friction = 0.3}},
      {stack + "-contact_base_role sticking", {.friction = 0.3, .pressure = 2}}};
  for (const auto& [options, to] : ways) {
    Condensed model(options);
    condensed::CondensedProblem whole(model.problem, model.closed);
    const sweep::Parameters from{.friction = 0.1};
    const auto first = whole.solve(from);
    ASSERT_TRUE(first.converged);
    const condensed::Line line{from, to};
    condensed::PathStates states(whole, line);
    double worst = 0;
    int compared = 0;
    for (unsigned draw = 0; draw < 40; ++draw) {
      condensed::ChosenSet set{{}, first.closed, first.sticking};
      change(set, model.model.contact, draw);
      const double end = states.reach(0, first.closed, first.sticking), s = end * draw / 39;
      set.at = line.at(s);
      const auto exact = whole.onSet(set), found = states.at(s, set.closed, set.sticking);
      EXPECT_EQ(found.found, exact.found) << draw;
      if (!exact.found) continue;
      worst = worse(worst, difference(found, exact, set.closed.size()));
      ++compared;
    }
    print("to friction %g, pressure %g: %d sets, largest difference %.1e, %d computed one by one\n",
          to.friction, to.pressure, compared, worst, states.computedSingly());
    EXPECT_GE(compared, 30);
    EXPECT_LE(states.computedSingly(), 10);
    EXPECT_LE(worst, 1e-9);
  }
}

}  // namespace
}  // namespace squeal::test
