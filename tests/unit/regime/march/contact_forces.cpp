// SPDX-License-Identifier: BSD-2-Clause
// Contact forces of time steps, against Siconos, a library for non-smooth dynamics, and what a
// march conserves.
#include "regime/march/contact_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "regime/march/scheme.hpp"
#include "support/algebra/dense.hpp"

// Its headers define macros of common names, and come last.
#include <siconos/numerics/FrictionContactProblem.h>
#include <siconos/numerics/Friction_cst.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/SolverOptions.h>

namespace squeal {
namespace {

constexpr int nodes = 8, modes = 6, rows = 3 * nodes;

/// Returns A Aᵀ scale + shift of a random A, so that the result is symmetric positive definite.
linalg::DenseMatrix definite(std::mt19937& generator, double scale, double shift) {
  linalg::DenseMatrix a(rows, rows);
  for (double& entry : a.entries()) entry = test::uniform(generator);
  linalg::DenseMatrix result = linalg::product(a, a);
  linalg::DenseMatrix transposed(rows, rows);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) transposed(i, j) = a(j, i);
  result = linalg::symmetricPart(linalg::product(a, transposed));
  for (double& entry : result.entries()) entry *= scale;
  for (int i = 0; i < rows; ++i) result(i, i) += shift;
  return result;
}

/// A random body in contact at eight nodes that slide with velocity 1 under the force 1 each.
march::ReducedModel randomModel() {
  std::mt19937 generator(7);
  march::ReducedModel model;
  model.nodes.resize(nodes);
  for (auto& node : model.nodes) {
    node.friction = 0.5, node.normalForce = 1;
    node.shear = {-0.5, 0}, node.velocity = {1, 0};
  }
  for (int i = 0; i < modes; ++i) model.stiffness.push_back(std::pow(1 + i, 2));
  model.damping = linalg::DenseMatrix(modes, modes);
  for (int i = 0; i < modes; ++i) model.damping(i, i) = 0.01;
  model.jump = model.couplingStiffness = linalg::DenseMatrix(rows, modes);
  model.couplingDamping = linalg::DenseMatrix(rows, modes);
  for (auto* matrix : {&model.jump, &model.couplingStiffness})
    for (double& entry : matrix->entries()) entry = 0.2 * test::uniform(generator);
  model.boundaryStiffness = definite(generator, 0.2, 2);
  model.boundaryDamping = definite(generator, 0.002, 0.02);
  model.boundaryMass = linalg::DenseMatrix(rows, rows);
  model.moves.assign(rows, 1);
  return model;
}

constexpr double h = 0.02;

/// A start so fast that nodes lift off and stick.
std::unique_ptr<march::Scheme> marched(const march::ReducedModel& model) {
  march::Start start;
  std::mt19937 generator(3);
  for (int i = 0; i < modes; ++i)
    start.q.push_back(0), start.v.push_back(6 * test::uniform(generator));
  start.z = start.zRate = std::vector<double>(rows, 0);
  return march::masslessScheme(model, start, h);
}

/// Returns (K_z + C_z/h)⁻¹.
linalg::DenseMatrix compliance(const march::ReducedModel& model) {
  linalg::DenseMatrix a = model.boundaryStiffness, inverse(rows, rows);
  linalg::addScaled(a, 1 / h, model.boundaryDamping);
  for (int i = 0; i < rows; ++i) inverse(i, i) = 1;
  linalg::Lu<double>(std::move(a)).solve(inverse);
  return inverse;
}

/// Returns the forces that Siconos finds.
std::vector<double> forcesOfSiconos(const linalg::DenseMatrix& w, std::vector<double> b,
                                    double friction) {
  std::vector<double> matrix(w.entries().begin(), w.entries().end()), mu(nodes, friction),
      reaction(rows), velocity(rows);
  NumericsMatrix* m = NM_create_from_data(NM_DENSE, rows, rows, matrix.data());
  FrictionContactProblem* problem =
      frictionContactProblem_new_with_data(3, nodes, m, b.data(), mu.data());
  SolverOptions* options = solver_options_create(SICONOS_FRICTION_3D_NSGS);
  options->dparam[SICONOS_DPARAM_TOL] = 1e-12;
  options->iparam[SICONOS_IPARAM_MAX_ITER] = 100'000;
  EXPECT_EQ(fc3d_driver(problem, reaction.data(), velocity.data(), options), 0);
  solver_options_delete(options);
  return reaction;
}

// Five steps of a march in which nodes are open, stick and slide at once. The forces are asked for
// to 1e-6 of their mean, 1: 1e-5 leaves room for the condition of W.
TEST(ContactForces, AreThoseOfSiconos) {
  const march::ReducedModel model = randomModel();
  const auto w = compliance(model);
  const auto scheme = marched(model);
  int open = 0, stuck = 0, slid = 0;
  for (int step = 1; step <= 100; ++step) {
    scheme->step();
    if (step % 20 != 0) continue;
    const auto &r = scheme->state().force, &d = scheme->increments();
    std::vector<double> b = d;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < rows; ++i) b[i] -= w(i, j) * r[j];
    const auto exact = forcesOfSiconos(w, b, 0.5);
    for (int i = 0; i < rows; ++i) EXPECT_NEAR(r[i], exact[i], 1e-5) << "step " << step;
    for (int node = 0; node < nodes; ++node) {
      const double* force = &exact[3 * node];
      const bool lifts = force[0] < 1e-9,
                 sticks = std::hypot(force[1], force[2]) < 0.5 * force[0] * (1 - 1e-6);
      open += lifts, stuck += !lifts && sticks, slid += !lifts && !sticks;
    }
    EXPECT_LE(scheme->lastDefect(), 1e-5);
  }
  EXPECT_GT(open, 0);
  EXPECT_GT(stuck, 0);
  EXPECT_GT(slid, 0);
}

// One node that slides, W = (1 c; c 1), b = (-1, 10): R_T = -f R_N, and d_N = 0 gives
// R_N = 1 / (1 - f c). With f c = -1.35, each sweep of the Gauss–Seidel method opens or closes the
// node again, for ever: the forces are those of Newton's method, from which a sweep departs by
// rounding.
TEST(ContactForces, StrongFrictionConverges) {
  linalg::DenseMatrix w(2, 2);
  w(0, 0) = w(1, 1) = 1, w(0, 1) = w(1, 0) = -0.9;
  const march::StepSolver solver(w, 2, {1, 1});
  std::vector<double> r = {0, 0}, d = {-1, 10};
  solver.solve({1.5}, {1}, 1e-10, r, d);
  EXPECT_NEAR(r[0], 1 / 2.35, 1e-14);
  EXPECT_NEAR(r[1], -1.5 / 2.35, 1e-14);
  EXPECT_NEAR(d[0], 0, 1e-14);
  EXPECT_NEAR(d[1], 10 - 2.4 / 2.35, 1e-13);
}

// Random problems of eight nodes with friction 1 and a compliance that couples them strongly: six
// vectors for 24 rows, and 0.02 on the diagonal. Without Newton's method the sweeps fail at four of
// them. Ten times the tolerance is the bound that the documentation states for a defect.
TEST(ContactForces, StrongFrictionOfManyNodesConverges) {
  const std::vector<unsigned char> moves(rows, 1), active(nodes, 1);
  const std::vector<double> friction(nodes, 1);
  int open = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937 generator(seed);
    linalg::DenseMatrix a(rows, 6), w(rows, rows);
    for (double& entry : a.entries()) entry = test::uniform(generator);
    std::vector<double> r(rows, 0), d, stiffness;
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < rows; ++j)
        for (int k = 0; k < 6; ++k) w(i, j) += a(i, k) * a(j, k) / 6;
      w(i, i) += 0.02;
      d.push_back(i % 3 == 0 ? -0.3 + test::uniform(generator) : 3 * test::uniform(generator));
      if (i % 3 == 0) stiffness.push_back(1 / w(i, i));
    }
    march::StepSolver(w, 3, moves).solve(friction, active, 1e-8, r, d);
    EXPECT_LE(march::defect(3, moves, friction, r, d, stiffness), 1e-7) << seed;
    for (int row = 0; row < rows; row += 3) {
      if (d[row] < 1e-6) continue;  // open: no force, not even round-off
      for (int c = 0; c < 3; ++c) EXPECT_EQ(r[row + c], 0) << seed;
      ++open;
    }
  }
  EXPECT_GT(open, 400);
}

// Forces that satisfy every condition have no defect; each condition broken by 0.1 is seen as such.
TEST(ContactForces, DefectSeesEachCondition) {
  const std::vector<unsigned char> moves(3, 1);
  const auto defectOf = [&](std::vector<double> r, std::vector<double> d) {
    return march::defect(3, moves, {0.5}, r, d, {1});
  };
  EXPECT_EQ(defectOf({0, 0, 0}, {1, 3, 0}), 0);                  // open
  EXPECT_EQ(defectOf({1, 0.1, 0.2}, {0, 0, 0}), 0);              // sticks
  EXPECT_NEAR(defectOf({1, -0.3, 0.4}, {0, 3, -4}), 0, 1e-15);   // slides
  EXPECT_NEAR(defectOf({1, 0, 0}, {0.1, 0, 0}), 0.1, 1e-15);     // pressed across a gap
  EXPECT_NEAR(defectOf({0, 0, 0}, {-0.1, 0, 0}), 0.1, 1e-15);    // penetrates
  EXPECT_NEAR(defectOf({-0.1, 0, 0}, {0.5, 0, 0}), 0.1, 1e-15);  // pulls
  EXPECT_NEAR(defectOf({1, -0.6, 0}, {0, 3, 0}), 0.1, 1e-15);    // beyond the cone
  EXPECT_NEAR(defectOf({1, 0.1, 0}, {0, 0.1, 0}), 0.1, 1e-15);   // slips inside the cone
}

// The scheme with mass and θ = 1/2 keeps the balance of energy exactly, whatever the contact does:
// what is left is rounding.
TEST(ContactForces, MarchKeepsTheBalanceOfEnergy) {
  march::ReducedModel model = randomModel();
  for (int i = 0; i < rows; ++i) model.boundaryMass(i, i) = 0.05;
  march::Start start;
  start.q.assign(modes, 0), start.v.assign(modes, 2);
  start.z = start.zRate = std::vector<double>(rows, 0);
  const auto scheme = march::moreauScheme(model, start, h);
  const double before = scheme->state().kinetic + 0.5 * modes * 4;
  for (int step = 0; step < 500; ++step) scheme->step();
  const auto& work = scheme->work();
  EXPECT_GT(work.moved, 1);
  EXPECT_NEAR(scheme->energy(), before + work.contact - work.damping, 1e-11 * work.moved);
}

}  // namespace
}  // namespace squeal
