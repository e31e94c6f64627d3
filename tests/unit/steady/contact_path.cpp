// Where along a sweep nodes open and close, against dense algebra on the condensed problem.
#include "steady/contact_path.hpp"

#include <gtest/gtest.h>

#include <string>

#include "contact/coupled.hpp"
#include "steady/condensed_problem.hpp"
#include "support/case.hpp"
#include "support/communicator.hpp"
#include "support/complementarity.hpp"
#include "support/gathered.hpp"
#include "support/model.hpp"

namespace squeal::test {
namespace {

// A block clamped at its foot, which a sliding plate presses: friction lifts its nodes one by one.
const std::string block =
    "-mesh_file meshes/layer.geo -mesh_set Lx=0.5,nx=4,ny=8 -material_layer_young 1e9 "
    "-material_layer_poisson 0.3 -material_layer_density 1000"
    " -constraint_bottom_clamped xy -contact_plate_pad top -contact_plate_obstacle_velocity 1,0,0 "
    "-contact_plate_obstacle_displacement 0,-0.001,0 -report_fields off ";

/// The normal force of a closed node or the gap of an open one, for a given set of open nodes.
double stateOf(const analysis::Analysis& analysis, double friction, const std::vector<bool>& open,
               std::size_t node) {
  const Condensed problem = condensed(analysis, friction);
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < open.size(); ++i)
    if (open[i]) which.push_back(i);
  Rows right;
  for (std::size_t i : which) right.push_back({-problem.q[i]});
  const Rows gaps = solved(part(problem.s, which, which), right);
  double force = problem.q[node];
  for (std::size_t k = 0; k < which.size(); ++k) {
    if (which[k] == node) return gaps[k][0];
    force += problem.s[node][which[k]] * gaps[k][0];
  }
  return force;
}

double zeroNear(const analysis::Analysis& analysis, double friction, const std::vector<bool>& open,
                std::size_t node) {
  double low = friction - 1e-3, high = friction + 1e-3;
  const bool positive = stateOf(analysis, low, open, node) > 0;
  EXPECT_NE(positive, stateOf(analysis, high, open, node) > 0);
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (stateOf(analysis, middle, open, node) > 0) == positive ? low = middle : high = middle;
  }
  return low;
}

TEST(ContactPath, NodesLiftOneByOne) {
  if (sizeOf() > 1) GTEST_SKIP() << "the dense problem is that of one rank";
  const analysis::Analysis analysis = runOptions(block + "-modes_count 5 -flutter_friction 0,0.5");
  const steady::Problem problem(*analysis.mesh, analysis.bodies, analysis.contact);
  const contact::CoupledSystem closed(analysis.bodies, analysis.contact,
                                      std::vector<unsigned char>(analysis.contact.nodes.size(), 1));
  steady::CondensedProblem condensedProblem(problem, closed);
  const auto first = condensedProblem.solve({0});
  const auto path = steady::followContact(condensedProblem, first, {0.5});
  EXPECT_EQ(path.obstacle, "");
  EXPECT_EQ(path.count, static_cast<int>(path.events.size()));
  std::vector<bool> open(first.closed.size(), false);
  double before = 0;
  for (const auto& event : path.events) {
    // The program solves to 1e-13 of the forces, and they change by their own size over the sweep.
    EXPECT_NEAR(event.at.friction, zeroNear(analysis, event.at.friction, open, event.node), 1e-9);
    EXPECT_GT(event.at.friction, before);
    EXPECT_EQ(event.opens, !open[event.node]);
    std::printf("friction %.12f: node %zu %s\n", event.at.friction, event.node,
                event.opens ? "opens" : "closes");
    open[event.node] = event.opens;
    before = event.at.friction;
  }
  const auto last = condensedProblem.solve({0.5});
  for (std::size_t i = 0; i < open.size(); ++i) EXPECT_EQ(open[i], last.closed[i] == 0);
  EXPECT_GE(path.count, 2);
}

}  // namespace
}  // namespace squeal::test
