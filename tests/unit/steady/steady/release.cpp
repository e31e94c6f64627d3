// SPDX-License-Identifier: BSD-2-Clause
// Nodes of a sticking interface that are released at their limit of friction: which of them are
// held again, and which are released again.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/system/mpi.hpp"
#include "model/mesh/vector.hpp"
#include "steady/steady/steady.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

using steady::Hold;

/// Two layers pressed and pulled aside. With this coefficient of friction all nodes slide.
struct Sliding {
  analysis::Analysis run =
      runCase("two_layers",
              "-mesh_set nx=6,ny_disc=2,ny_pad=2 -constraint_pad_top_displacement 0.004,-0.01,0 "
              "-flutter_friction 0 -modes_count 5 -flutter_track off -steady_uniqueness off "
              "-contact_interface_role sticking -contact_interface_friction 0.05 "
              "-contact_interface_release on");
  const contact::Contact& contact = run.model.contact;
  steady::Solution& state = run.steady.solutions.at(0);

  /// Holds all nodes. Their forces along the surface exceed the limit: twice at the node with
  /// x = 0, by 60 % at the next one, by 20 % at all others.
  void holdBeyondLimit(unsigned char slidBack) {
    for (std::size_t i = 0; i < state.contact.size(); ++i) {
      const double x = contact.interfaces.nodes[i].position[0], factor = x < 0.25   ? 2
                                                                         : x < 0.75 ? 1.6
                                                                                    : 1.2;
      state.sticking.holds[i] = Hold::held;
      state.sticking.slidBack[i] = slidBack;
      state.contact[i].frictionForce = {factor * 0.05 * state.contact[i].normalForce};
    }
  }
};

/// Returns the number of released nodes of all ranks.
int released(const steady::Sticking& sticking) {
  const int own = std::ranges::count(sticking.holds, Hold::released);
  return mpi::sum(PETSC_COMM_WORLD, own);
}

TEST(Release, AllNodesSlideAtFirst) {
  Sliding layers;
  ASSERT_TRUE(layers.state.converged) << layers.state.reason;
  EXPECT_EQ(released(layers.state.sticking), 6);  // x = 0, 0.5, …, 2.5: the ends are one node
  EXPECT_EQ(layers.state.resultants.at(0).returned, 0);
  EXPECT_FALSE(steady::revised(layers.contact, layers.state));
  layers.holdBeyondLimit(0);
  const auto next = steady::revised(layers.contact, layers.state);
  ASSERT_TRUE(next);
  EXPECT_EQ(released(*next), 6);
}

// Of nodes that have slid back, those that exceed their limit by at least half as much as the
// worst: by 100 % and 60 %, not by 20 %.
TEST(Release, OnlyTheWorstAreReleasedAgain) {
  Sliding layers;
  layers.holdBeyondLimit(1);
  const auto next = steady::revised(layers.contact, layers.state);
  ASSERT_TRUE(next);
  EXPECT_EQ(released(*next), 2);
  const auto& nodes = layers.contact.interfaces.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_EQ(next->holds[i] == Hold::released, nodes[i].position[0] < 0.75);
}

// A node whose friction points along its slip is held again, three times at most. Then it is
// counted.
TEST(Release, NodesThatSlideBackAreHeldAgain) {
  Sliding layers;
  auto& [holds, direction, heldAgain, slidBack] = layers.state.sticking;
  for (auto& d : direction) d = mesh::scaled(d, -1);
  const auto next = steady::revised(layers.contact, layers.state);
  ASSERT_TRUE(next);
  EXPECT_EQ(released(*next), 0);
  for (std::size_t i = 0; i < next->holds.size(); ++i) {
    EXPECT_EQ(next->holds[i], Hold::held);
    EXPECT_EQ(next->slidBack[i], 1);
  }
  std::ranges::fill(slidBack, steady::mostReturns);
  EXPECT_FALSE(steady::revised(layers.contact, layers.state));
  steady::countReturned(layers.contact, layers.state);
  EXPECT_EQ(layers.state.resultants.at(0).returned, 6);
}

}  // namespace
}  // namespace squeal::test
