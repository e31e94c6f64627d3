// SPDX-License-Identifier: BSD-2-Clause
// Where along a sweep nodes open and close, against dense algebra on the condensed problem.
#include "steady/condensed/contact_path.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/system/text.hpp"
#include "model/contact/coupled.hpp"
#include "steady/condensed/condensed_problem.hpp"
#include "support/harness/largest_error.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"
#include "support/steady/complementarity.hpp"
#include "support/steady/pressed_block.hpp"

namespace squeal::test {
namespace {

const std::string block = pressedBlock + " -report_fields off ";

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
  const steady::Problem problem(*analysis.model.mesh, analysis.model.bodies,
                                analysis.model.contact);
  const contact::CoupledSystem closed(
      analysis.model.bodies, analysis.model.contact,
      contact::ActiveSet::bonded(analysis.model.contact.interfaces.nodes.size()));
  condensed::CondensedProblem condensedProblem(problem, closed);
  const sweep::Parameters begin{.friction = 0, .speed = 3}, end{.friction = 0.5, .speed = 3};
  const auto first = condensedProblem.solve(begin);
  const auto path = condensed::traceContact(condensedProblem, first, end);
  EXPECT_EQ(path.obstacle, "");
  EXPECT_EQ(path.count, static_cast<int>(path.events.size()));
  std::vector<bool> open(first.closed.size(), false);
  double before = 0;
  for (const auto& event : path.events) {
    // The program solves to 1e-13 of the forces, and they change by their own size over the sweep.
    EXPECT_NEAR(event.at.friction, zeroNear(analysis, event.at.friction, open, event.node), 1e-9);
    EXPECT_GT(event.at.friction, before);
    EXPECT_EQ(event.at.speed, end.speed);  // to the last bit: it identifies the point
    const bool opens = event.change == condensed::Change::opens;
    EXPECT_EQ(opens, !open[event.node]);
    std::printf("friction %.12f: node %zu %s\n", event.at.friction, event.node,
                condensed::text(event.change).c_str());
    open[event.node] = opens;
    before = event.at.friction;
  }
  const auto last = condensedProblem.solve(end);
  for (std::size_t i = 0; i < open.size(); ++i) EXPECT_EQ(open[i], last.closed[i] == 0);
  EXPECT_GE(path.count, 2);
}

/// The way from friction 0 to another one, with what it needs to exist.
struct Way {
  Way(const std::string& options, double friction)
      : Way(runOptions(options + " -modes_count 1 -flutter_friction 0"), friction) {}
  Way(analysis::Analysis found, double friction)
      : analysis(std::move(found)),
        problem(*analysis.model.mesh, analysis.model.bodies, analysis.model.contact),
        closed(analysis.model.bodies, analysis.model.contact,
               contact::ActiveSet::bonded(analysis.model.contact.interfaces.nodes.size())),
        condensedProblem(problem, closed),
        path(condensed::traceContact(condensedProblem, condensedProblem.solve({0}), {friction})) {}
  analysis::Analysis analysis;
  steady::Problem problem;
  contact::CoupledSystem closed;
  mutable condensed::CondensedProblem condensedProblem;
  condensed::ContactPath path;
};

/// Determinant of a 3×3 matrix.
double determinant(const Rows& a) {
  double sum = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t k = (j + 1) % 3, l = (j + 2) % 3;
    sum += a[0][j] * (a[1][k] * a[2][l] - a[1][l] * a[2][k]);
  }
  return sum;
}

// One square of bilinear elements, clamped below, is sheared by a plate that presses it. One node
// opens at first. With the other one closed, u = (x, y) of the open node and x of the closed one
// solve (K + f e nᵀ) u = …, where nᵀ u is the normal force and e its place: det(K) + f det(K with n
// as the row of the closed node) = 0.
TEST(ContactPath, FrictionWithoutASolutionOfOneElement) {
  if (sizeOf() > 1) GTEST_SKIP() << "there is one element";
  for (const double poisson : {0.2, 0.3, 0.4}) {
    const double lambda = poisson / ((1 + poisson) * (1 - 2 * poisson)),
                 mu = 1 / (2 * (1 + poisson)), l = lambda + 2 * mu;  // of E
    const double same = (l + mu) / 3, along = -l / 3 + mu / 6, across = l / 6 - mu / 3,
                 mixed = (lambda + mu) / 4, other = (lambda - mu) / 4;
    // Upper nodes: 1 on the right is open, 2 on the left closed. Unknowns x1, y1, x2.
    const Rows k{{same, mixed, along}, {mixed, same, -other}, {along, -other, same}};
    Rows turned = k;
    turned[2] = {other, across, -mixed};                         // force along y at node 2
    const double exact = -determinant(k) / determinant(turned);  // 3/2 − 2ν/3
    const Way way(formatted("-mesh_file meshes/layer.geo -mesh_set Lx=1,h=1,nx=1,ny=1 "
                            "-material_layer_young 1 -material_layer_poisson %g "
                            "-material_layer_density 1 -constraint_bottom_clamped xy "
                            "-contact_plate_pad top -contact_plate_obstacle_velocity 1,0,0 "
                            "-contact_plate_obstacle_displacement 0,-0.001,0 -report_fields off",
                            poisson),
                  10);
    print("Poisson's ratio %g: %.12f, exactly %.12f, %d event\n", poisson, way.path.end.friction,
          exact, way.path.count);
    EXPECT_EQ(way.path.count, 1);
    EXPECT_NE(way.path.obstacle.find("singular"), std::string::npos) << way.path.obstacle;
    EXPECT_NEAR(exact, 1.5 - 2 * poisson / 3, 1e-14);
    EXPECT_NEAR(way.path.end.friction, exact, 1e-9);
  }
}

/// A block with an inclined face on an inclined obstacle that is moved by `height`, m, along y.
class Incline {
 public:
  Incline()
      : file_(std::filesystem::temp_directory_path() /
              ("squeal_incline_" + std::to_string(getpid()) + ".geo")) {
    std::ofstream(file_)
        << "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 0.6, 0}; "
           "Point(4) = {0, 1, 0};\n"
           "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, "
           "1};\n"
           "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
           "Transfinite Curve {1, 2, 3, 4} = 5; Transfinite Surface {1}; Recombine "
           "Surface {1};\n"
           "Physical Curve(\"bottom\") = {1}; Physical Curve(\"face\") = {3};\n"
           "Physical Surface(\"block\") = {1};\n";
  }
  ~Incline() { std::filesystem::remove(file_); }
  std::string options(const std::string& velocity, double height) const {
    return "-mesh_file " + file_.string() +
           " -material_block_young 1e9 -material_block_poisson 0.3 -material_block_density 1000 "
           "-constraint_bottom_clamped xy -contact_plate_pad face "
           "-contact_plate_obstacle_velocity " +
           velocity + formatted(" -contact_plate_obstacle_displacement 0,%g,0", height) +
           " -report_fields off";
  }

 private:
  std::filesystem::path file_;
};

// Up to the friction that is found, and not beyond, one of all sets of open nodes has gaps and
// forces that are not negative.
TEST(ContactPath, FrictionWithoutASolutionOnAnIncline) {
  if (sizeOf() > 1) GTEST_SKIP() << "the dense problem is that of one rank";
  const Incline incline;
  for (const std::string velocity : {"1,-0.4,0", "-1,0.4,0"}) {
    const Way way(incline.options(velocity, -0.001), 5);
    const double end = way.path.end.friction;
    print("sliding along %s: %d events, end at friction %.9f: %s\n", velocity.c_str(),
          way.path.count, end, way.path.obstacle.c_str());
    EXPECT_NE(way.path.obstacle, "");
    EXPECT_FALSE(allSolutions(condensed(way.analysis, (1 - 1e-6) * end)).empty());
    EXPECT_TRUE(allSolutions(condensed(way.analysis, (1 + 1e-6) * end)).empty());
  }
}

// An obstacle that does not touch the block, which from some friction on could wedge it as well:
// the sweep stays where it comes from.
TEST(ContactPath, OfSeveralSolutionsTheSweepKeepsItsOwn) {
  if (sizeOf() > 1) GTEST_SKIP() << "the dense problem is that of one rank";
  const Incline incline;
  const auto analysis = runOptions(incline.options("1,-0.4,0", 0.001) +
                                   " -flutter_friction 0,1,1.5,2 -modes_count 1 "
                                   "-flutter_method direct "
                                   "-flutter_direct_count 1");
  ASSERT_EQ(analysis.steady.solutions.size(), 4U);
  EXPECT_EQ(allSolutions(condensed(analysis, 1)).size(), 1U);
  EXPECT_GT(allSolutions(condensed(analysis, 1.5)).size(), 1U);
  for (const auto& solution : analysis.steady.solutions) {
    EXPECT_TRUE(solution.converged);
    EXPECT_EQ(solution.openNodes, analysis.model.contact.interfaces.totalNodes)
        << solution.at.friction;
  }
  EXPECT_EQ(analysis.steady.solutions[1].nodesOfAnother, 0);
  EXPECT_GT(analysis.steady.solutions[2].nodesOfAnother, 0);
}

// The brake without slope of its pads: between the steady states just below and just above each
// event, found by SNES VI, the node of the event changes and no other one.
TEST(ContactPath, EventsOfABrakeAreConfirmedBesideThem) {
  const Way way(runCase("disc_brake",
                        "-mesh_set slope=0,n_disc_theta=6,n_free_theta=12 -modes_count 1 "
                        "-flutter_friction 0 -report_fields off"),
                0.6);
  EXPECT_EQ(way.path.obstacle, "");
  EXPECT_GT(way.path.count, 0);
  // Nearer, the force of the node is below what solving to 1e-11 of the loads leaves.
  constexpr double beside = 1e-6;
  std::size_t mine = 0;
  for (int order = 0; order < way.path.count; ++order) {
    const bool isMine = mine < way.path.events.size() && way.path.events[mine].order == order;
    const double friction = largest(isMine ? way.path.events[mine].at.friction : 0);
    const auto below = way.condensedProblem.solve({(1 - beside) * friction}),
               above = way.condensedProblem.solve({(1 + beside) * friction});
    EXPECT_TRUE(below.converged && above.converged);
    for (std::size_t i = 0; i < below.closed.size(); ++i) {
      const bool changes = isMine && way.path.events[mine].node == i;
      EXPECT_EQ(below.closed[i] != above.closed[i], changes) << friction;
      if (changes) {
        EXPECT_EQ(below.closed[i] != 0, way.path.events[mine].change == condensed::Change::opens);
      }
    }
    print("friction %.12f confirmed\n", friction);
    mine += isMine;
  }
}

}  // namespace
}  // namespace squeal::test
