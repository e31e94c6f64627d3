// SPDX-License-Identifier: BSD-2-Clause
// Steady sliding with convective terms: w = −V − D u_D turns and changes its length with the
// unknown displacement.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <utility>

#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"
#include "model/contact/coupled.hpp"
#include "steady/steady/complementarity.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/largest_error.hpp"
#include "support/harness/program.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"
#include "support/steady/strained_slider.hpp"

namespace squeal {
namespace {

using mesh::Point;
namespace slider = test::slider;

/// All numbers after `label`.
std::vector<double> numbersAfter(const std::string& text, const std::string& label) {
  std::vector<double> numbers;
  for (std::size_t at = text.find(label); at != std::string::npos; at = text.find(label, at + 1))
    numbers.push_back(std::stod(text.substr(at + label.size())));
  return numbers;
}

// PETSc's own difference quotients of every column, and Newton's convergence, as a user sees them.
TEST(Steady, NewtonConvergesQuadratically) {
  const std::string options = slider::options(1, 0.6);
  int size = 0;
  check(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  if (size > 1) GTEST_SKIP() << "starts the program itself";
  const auto run = test::runProgram(
      "steady", 2,
      options +
          "-flutter_friction 0.4 -modes_count 2 -steady_full on -steady_snes_test_jacobian "
          "-steady_snes_monitor");
  ASSERT_EQ(run.exitCode, 0) << run.error;
  // The preconditioner, which is tested in between, is the frictionless stiffness.
  const std::string own =
      std::regex_replace(run.out, std::regex("Jacobian for preconditioner[^=]*= "), "");
  const auto differences = numbersAfter(own, "||J - Jfd||_F/||J||_F = "),
             norms = numbersAfter(run.out, "SNES Function norm ");
  ASSERT_GE(norms.size(), 3u) << run.out;
  EXPECT_LE(norms.size(), 8u);
  ASSERT_EQ(differences.size() + 1, norms.size());
  for (double difference : differences) EXPECT_LT(difference, 1e-6);
  EXPECT_LT(norms[1],
            norms[0]);  // contact nodes open in the first step, which ends its quadratic decrease
  for (std::size_t i = 2; i < norms.size(); ++i)
    EXPECT_LT(norms[i], std::max(norms[i - 1] * norms[i - 1], 1e-13));  // rounding
  std::printf("Jacobian against PETSc's differences: %.1e; norms",
              *std::max_element(differences.begin(), differences.end()));
  for (double norm : norms) std::printf(" %.1e", norm);
  std::printf("\n");
}

/// Random ones up to `scale`.
OwnedVec unknowns(const contact::Contact& contact, double scale, unsigned long seed) {
  const auto transformation =
      contact.transformation(contact::ActiveSet::open(contact.interfaces.nodes.size()));
  OwnedVec x;
  check(MatCreateVecs(transformation.trial, x.out(), nullptr));
  PetscRandom random = nullptr;
  check(PetscRandomCreate(PETSC_COMM_WORLD, &random));
  check(PetscRandomSetInterval(random, -scale, scale));
  check(PetscRandomSetSeed(random, seed));
  check(PetscRandomSeed(random));
  check(VecSetRandom(x, random));
  check(PetscRandomDestroy(&random));
  return x;
}

double distance(Vec a, Vec b) {
  OwnedVec difference;
  PetscReal size = 0;
  check(VecDuplicate(a, difference.out()));
  check(VecWAXPY(difference, -1, b, a));
  check(VecNorm(difference, NORM_2, &size));
  return size;
}

OwnedVec product(const OwnedMat& matrix, Vec x) {
  OwnedVec y;
  check(MatCreateVecs(matrix, nullptr, y.out()));
  check(MatMult(matrix, x, y));
  return y;
}

/// J d at x, displacements of the size `scale`, against (F(x + h d) − F(x − h d)) / 2h. F depends
/// on its slip, which makes it nonlinear, by a part of J that may be small beside the stiffness:
/// the error is measured by that part.
void expectDerivative(const std::string& name, double scale) {
  const test::Model model = test::buildModel();
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  ASSERT_TRUE(model.contact.sliding.convected);
  const sweep::Parameters at{0.4, 1.3};
  double worst = 0, smallestShare = INFINITY;
  for (unsigned long seed = 1; seed <= 3; ++seed) {
    const OwnedVec x = unknowns(model.contact, scale, seed),
                   d = unknowns(model.contact, scale, 10 + seed);
    OwnedVec rest, moved, forward, backward;
    for (OwnedVec* vector : {&rest, &moved, &forward, &backward})
      check(VecDuplicate(x, vector->out()));
    check(VecZeroEntries(rest));
    const OwnedVec exact = product(problem.jacobian(at, x), d),
                   linear = product(problem.jacobian(at, rest), d);
    constexpr double h = 2e-4;  // the slip changes by about h/10: an error of its square; rounding,
                                // 1e-16 / h of the whole, is 1e-12
    check(VecWAXPY(moved, h, d, x));
    problem.residual(at, moved, forward);
    check(VecWAXPY(moved, -h, d, x));
    problem.residual(at, moved, backward);
    check(VecAXPBY(forward, -0.5 / h, 0.5 / h, backward));
    PetscReal size = 0;
    check(VecNorm(exact, NORM_2, &size));
    const double error = distance(exact, forward), nonlinear = distance(exact, linear);
    worst = test::worse(worst, error / nonlinear);
    smallestShare = std::min(smallestShare, nonlinear / size);
    EXPECT_LT(error, 1e-7 * nonlinear) << name;
    EXPECT_GT(nonlinear, 1e-5 * size) << name;
  }
  test::print(
      "%s: Jacobian against differences %.1e of its nonlinear part, which is %.1e of the whole\n",
      name.c_str(), worst, smallestShare);
}

// At this friction corrections with the derivative of the problem without convective terms do not
// halve the residual.
TEST(Steady, StrongConvectiveTermsAreSolvedForInAllUnknowns) {
  int size = 0;
  check(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  if (size > 1) GTEST_SKIP() << "starts the program itself";
  for (const auto& [friction, where] :
       {std::pair{"0.2", " after"}, {"0.8", ", in all unknowns after"}}) {
    const auto run = test::runProgram("steady", 2,
                                      slider::options(1, 0.6) + "-flutter_friction " + friction +
                                          " -modes_count 2 -report_fields off");
    ASSERT_EQ(run.exitCode, 0) << run.error;
    EXPECT_NE(run.out.find(std::string("friction ") + friction + ": CONVERGED_FNORM_ABS" + where),
              std::string::npos)
        << run.out;
  }
}

// A solver that has converged for its own function although the equations are not fulfilled.
TEST(Steady, RefusedResidualIsTheReason) {
  steady::Solution solution;
  solution.reason = "CONVERGED_FNORM_ABS";
  solution.tolerance = 1e-11;
  steady::accept(solution, 3.5e-7, {.forceUnit = 100, .target = 1e-11});
  EXPECT_FALSE(solution.converged);
  EXPECT_EQ(solution.reason,
            "the solver of the contact stopped at a relative residual of all equations of 3.5e-09, "
            "above the accepted 1e-10 (CONVERGED_FNORM_ABS)");
  solution.reason = "CONVERGED_FNORM_ABS";
  steady::accept(solution, 9e-9, {.forceUnit = 100, .target = 1e-11});
  EXPECT_TRUE(solution.converged);
  EXPECT_EQ(solution.reason, "CONVERGED_FNORM_ABS");
}

TEST(Steady, JacobianIsTheDerivative) {
  for (const int order : {1, 2})
    for (const double depth : {0.0, 0.6}) {
      test::setOptions(slider::options(order, depth));
      expectDerivative(formatted("slider, order %d, depth %g", order, depth), 0.02);
    }
}

TEST(Steady, JacobianIsTheDerivativeOnACircle) {
  test::setOptions(
      "-mesh_file meshes/cylinders.geo -mesh_set order=2,n_inner=2,n_outer=2,n_theta=16" +
      test::material("inner", "7e10", "0.33", "2700") +
      test::material("outer", "2.1e11", "0.3", "7850") +
      "-constraint_sym_x_clamped x -constraint_sym_y_clamped y -contact_ring_pad inner_face "
      "-contact_ring_disc outer_face "
      "-motion_outer_speed 2 -motion_convective on " +
      slider::law);
  expectDerivative("cylinders", 4e-3);
}

const std::string coarseBrake =
    "-mesh_set "
    "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,n_hat=2,n_h_ring=2 ";

TEST(Steady, JacobianIsTheDerivativeOnADisc) {
  test::setCase("disc_brake", coarseBrake + "-motion_convective on " + slider::law);
  expectDerivative("disc brake", 1e-3);
}

/// u and the place of every node, on every rank.
struct Field {
  int dimension;
  std::vector<double> place, u;

  Point at(const std::vector<double>& values, std::size_t node) const {
    Point point{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
      point[d] = values[node * static_cast<std::size_t>(dimension) + d];
    return point;
  }
};

/// ∂u/∂x of the disc's surface at the contact node at `x` by differences between the nodes beside
/// it, within 1 ≤ x ≤ 2, under the pad. `disc`: the disc's node of each place.
Point slope(const Field& field, const std::map<std::pair<int, int>, std::size_t>& disc,
            const Point& x) {
  const auto key = [](const Point& p) {
    return std::pair(static_cast<int>(std::lround(p[0] / slider::step)),
                     static_cast<int>(std::lround(1000 * p[2])));
  };
  Point low = x, high = x;
  low[0] = std::max(1.0, x[0] - slider::step), high[0] = std::min(2.0, x[0] + slider::step);
  const Point a = field.at(field.u, disc.at(key(low))), b = field.at(field.u, disc.at(key(high)));
  Point result{};
  for (std::size_t d = 0; d < 3; ++d) result[d] = (b[d] - a[d]) / (high[0] - low[0]);
  return result;
}

// With n = e_y: on the pad the contact force is R_N n − f φ(|w|) R_N w/|w|, w = −v (V + D u_D)
// without its part along n. The force is the residual of the pad's own nodes, D u_D = V ∂u_D/∂x a
// difference of displacements: of linear cells of equal length it is what the contact takes it for.
void expectCoulomb(double depth) {
  test::setOptions(slider::options(1, depth));
  const test::Model model = test::buildModel();
  const auto& mesh = *model.mesh;
  const auto dimension = static_cast<std::size_t>(mesh.dimension);
  const contact::CoupledSystem system(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  const sweep::Parameters at{0.4, 1.3};
  const auto solution = steady::Problem(mesh, model.bodies, model.contact).solve(at, system);
  ASSERT_TRUE(solution.converged) << solution.reason;
  EXPECT_LE(solution.iterations, 8);
  EXPECT_LT(solution.imbalance, 1e-10);

  const Field field{mesh.dimension,
                    test::allEntries(test::nodalField(mesh, [](const Point& x) { return x; })),
                    test::allEntries(solution.displacement)};
  const OwnedVec residual = elasticity::nodalVector(
      mesh);  // of the pad, which is at rest and carries no load but supports
  check(MatMult(model.bodies.stiffness, solution.displacement, residual));
  check(VecAXPY(residual, -1, model.bodies.load));
  const auto force = test::allEntries(residual);
  // The disc's nodes under the pad, on all ranks: masters are known where the contact node is.
  std::vector<double> master(field.u.size() / dimension, 0.0);
  for (const auto& node : model.contact.interfaces.nodes) master[node.master] = 1;
  check(MPI_Allreduce(MPI_IN_PLACE, master.data(), static_cast<int>(master.size()), MPI_DOUBLE,
                      MPI_MAX, PETSC_COMM_WORLD));
  std::map<std::pair<int, int>, std::size_t> disc;
  for (std::size_t node = 0; node < master.size(); ++node) {
    const Point x = field.at(field.place, node);
    if (master[node] > 0)
      disc[{static_cast<int>(std::lround(x[0] / slider::step)),
            static_cast<int>(std::lround(1000 * x[2]))}] = node;
  }

  double error = 0, turning = 0, slowing = 0, largest = 0;
  for (const auto& state : solution.contact) largest = test::worse(largest, state.normalForce);
  largest = test::largest(largest);
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& node = model.contact.interfaces.nodes[i];
    Point w = slope(field, disc, node.position);
    for (double& component : w) component *= -at.speed * slider::speed;
    w[0] -= at.speed * slider::speed;
    w[1] = 0;
    const double size = std::hypot(w[0], w[2]),
                 phi = 1 + (slider::staticRatio - 1) * std::exp(-size / slider::decaySpeed);
    const auto first = dimension * static_cast<std::size_t>(node.globalNode);
    const double normal = force[first + 1];
    for (std::size_t d = 0; d < dimension; ++d) {
      const double wanted = d == 1 ? normal : -at.friction * phi * normal * w[d] / size;
      error = test::worse(error, std::abs(force[first + d] - wanted) / largest);
    }
    EXPECT_NEAR(solution.contact[i].normalForce, normal, 1e-10 * largest);
    turning = test::worse(turning, std::abs(w[2]) / size);
    slowing = test::worse(slowing, std::abs(size / (at.speed * slider::speed) - 1));
  }
  error = test::largest(error), turning = test::largest(turning), slowing = test::largest(slowing);
  test::print(
      "depth %g: %d iterations, %d nodes open, slip turns by %.2g and changes by %.2g; Coulomb's "
      "law holds to %.1e of the largest "
      "force\n",
      depth, solution.iterations, static_cast<int>(solution.openNodes), turning, slowing, error);
  EXPECT_LT(error, 1e-9);    // SNES stops at 1e-11 of its first residual
  EXPECT_GT(slowing, 0.02);  // where it is measured, a slip of −V would fail by as much
  if (depth > 0) {           // in the plane the slip has one line to lie on
    EXPECT_GT(turning, 0.1);
  }
}

TEST(Steady, FrictionOpposesTheSlipOfTheDeformedDisc) {
  expectCoulomb(0);
  expectCoulomb(0.6);
}

// A row of cells with reduced integration on springs at one end: a plate holds their hourglass
// modes as long as it is pressed on them.
TEST(Steady, OpenContactThatLeavesHourglassModesIsNoSolution) {
  const auto solve = [](double pressure) {
    test::setOptions(
        "-mesh_file meshes/beam.geo -mesh_set order=2,serendipity=1,Lx=2,Ly=0.7,Lz=0.5,nx=3,ny=1,"
        "nz=1 -material_beam_integration reduced -ground_clamped_stiffness 1,1,1 "
        "-contact_plate_pad bottom -contact_plate_role frictionless "
        "-contact_plate_obstacle_velocity 0,0,0 " +
        test::material("beam", "2", "0.3", "1") + formatted("-load_top_pressure %g", pressure));
    const auto model = test::buildModel();
    const contact::CoupledSystem system(
        model.bodies, model.contact,
        contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
    return steady::Problem(*model.mesh, model.bodies, model.contact).solve({0}, system);
  };
  const auto pressed = solve(1e-3), lifted = solve(-1e-3);
  EXPECT_TRUE(pressed.converged) << pressed.reason;
  EXPECT_FALSE(lifted.converged);
  EXPECT_EQ(lifted.reason.find("body 'beam' has 3 hourglass modes"), 0u) << lifted.reason;
}

}  // namespace
}  // namespace squeal
